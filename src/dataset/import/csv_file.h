#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"
#include "dataset/import/table_text.h"

namespace tera {

/// Syntax of a foreign table.
struct CsvForm {
  char separator = 0;  ///< 0: the first of tab, semicolon, bar, comma and blanks in its first line
  bool has_header = true;  ///< else columns are named by their numbers, from "1" on
  int skipped_lines = 0;   ///< before the header, or before the first row
  int unit_lines = 0;      ///< lines of units and the like after the header, without empty ones
  /// Range of lines with rows; 0: no limit.
  int first_line = 0, last_line = 0;
  NumberForm numbers;
};

/// The tables of several files of one form, concatenated; the plain table for one file. Throws
/// InputError if their columns differ, and as CsvFile does.
std::unique_ptr<const RowTable> ReadTextTables(const std::vector<std::filesystem::path>& files,
                                               const CsvForm& form, LeftOutRows* left_out);

/// A foreign table in a text file, in memory. Every fault is an InputError with file:line, the
/// finding and the need.
class CsvFile final : public RowTable {
 public:
  /// Reads the file as DecodedTable does. Fields may have quotes and surrounding blanks. Empty
  /// lines, lines that begin with '#' or '%', separators at the end of rows and an unterminated
  /// last line are accepted. Columns without a name are named by their numbers; the k-th column of
  /// a repeated name is "NAME#k". Rows with too few or too many fields are a fault, or go to
  /// `left_out` if given.
  CsvFile(const std::filesystem::path& path, const CsvForm& form, LeftOutRows* left_out);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t row_count() const override {
    return columns_.empty() ? 0 : fields_.size() / columns_.size();
  }

  std::size_t Column(const std::string& name) const override;
  int Line(std::size_t row) const override { return line_of_row_[row]; }
  std::size_t Ordinal(std::size_t row) const override { return ordinals_[row]; }
  /// Number of rows including the left out ones.
  std::size_t ordinal_count() const { return ordinal_count_; }
  std::string_view Field(std::size_t row, std::size_t column) const {
    const Place place = fields_[row * columns_.size() + column];
    return std::string_view(*text_).substr(place.begin, place.bytes);
  }
  std::optional<std::string_view> Text(std::size_t row, std::size_t column) const override {
    return Field(row, column);
  }
  std::optional<double> NumberIfAny(std::size_t row, std::size_t column) const override {
    return NumberOfField(Field(row, column), numbers_);
  }
  double Number(std::size_t row, std::size_t column) const override;
  std::optional<TimeNs> Stamp(std::size_t, std::size_t) const override { return std::nullopt; }
  std::optional<TimeNs> WholeNanoseconds(std::size_t row, std::size_t column,
                                         TimeNs unit_ns) const override;
  bool IsPresent(std::size_t row, std::size_t column) const override {
    return !SaysNothing(Field(row, column));
  }
  bool Repeats(std::size_t row, std::size_t column) const override {
    return Field(row, column) == Field(row - 1, column);
  }
  [[noreturn]] void Fail(std::size_t row, std::size_t column,
                         const InputFault& fault) const override;

 private:
  /// Position of a field in the text, half the size of a view: files have 1e8 fields.
  struct Place {
    std::uint64_t begin : 40, bytes : 24;
  };

  void NameColumns(const std::vector<std::string_view>& names);
  void ReadRows(std::string_view rest, const CsvForm& form, LeftOutRows* left_out);
  /// Removes the empty fields of separators at the end of a row.
  void DropEmptyEnd(std::vector<std::string_view>* fields) const;
  std::string WrongFieldCount(std::size_t found, bool is_last) const;
  [[noreturn]] void FailAtLine(int line, const InputFault& fault) const;
  void AddRow(const std::vector<std::string_view>& fields, int line);

  std::filesystem::path path_;
  std::unique_ptr<const std::string>
      text_;  ///< on the heap, so that fields stay valid when the file is moved
  std::vector<std::string> columns_;
  std::vector<Place> fields_;  ///< row by row
  std::vector<int> line_of_row_;
  std::vector<std::size_t> ordinals_;
  std::size_t ordinal_count_ = 0;
  NumberForm numbers_;
  int header_line_ = 1;  ///< 0: none
};

}  // namespace tera
