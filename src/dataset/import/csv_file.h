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

/// How a foreign table is written.
struct CsvForm {
  char separator = 0;  ///< 0: the one of tab, semicolon, bar, comma and blanks of its first line
  bool has_header = true;  ///< else columns are named by their numbers, from "1" on
  int skipped_lines = 0;   ///< before the header, or before the first row
  int unit_lines = 0;      ///< behind the header, of units and the like; empty ones do not count
  /// Rows in lines before the first and behind the last are not there; 0: all are.
  int first_line = 0, last_line = 0;
  NumberForm numbers;
};

/// The tables of several files of one form, one behind the other; a table of one file is that
/// file's. Throws InputError where their columns differ, and what CsvFile throws.
std::unique_ptr<const RowTable> ReadTextTables(const std::vector<std::filesystem::path>& files,
                                               const CsvForm& form, LeftOutRows* left_out);

/// A foreign table in a text file, in memory. Every fault is an InputError with file:line, what was
/// found and what is needed.
class CsvFile final : public RowTable {
 public:
  /// Reads the file as DecodedTable does, whose fields may stand in quotes and have blanks
  /// around them, which may have empty lines, lines that begin with '#' or '%', separators at the
  /// end of rows and a last line without end. Columns without a name are named by their numbers;
  /// of those of one name the k-th is "NAME#k". Rows with too few or too many fields are a fault,
  /// or are `left_out` where that is given.
  CsvFile(const std::filesystem::path& path, const CsvForm& form, LeftOutRows* left_out);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t row_count() const override {
    return columns_.empty() ? 0 : fields_.size() / columns_.size();
  }

  std::size_t Column(const std::string& name) const override;
  int Line(std::size_t row) const override { return line_of_row_[row]; }
  std::size_t Ordinal(std::size_t row) const override { return ordinals_[row]; }
  /// How many rows there are with those that were left out.
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
  /// Where a field is in the text, in half of what a view of it takes: files have 1e8 of them.
  struct Place {
    std::uint64_t begin : 40, bytes : 24;
  };

  void NameColumns(const std::vector<std::string_view>& names);
  void ReadRows(std::string_view rest, const CsvForm& form, LeftOutRows* left_out);
  /// Without the empty fields that separators at the end of a row make.
  void DropEmptyEnd(std::vector<std::string_view>* fields) const;
  std::string WrongFieldCount(std::size_t found, bool is_last) const;
  [[noreturn]] void FailAtLine(int line, const InputFault& fault) const;
  void AddRow(const std::vector<std::string_view>& fields, int line);

  std::filesystem::path path_;
  std::unique_ptr<const std::string> text_;  ///< apart, so that a moved file keeps its fields valid
  std::vector<std::string> columns_;
  std::vector<Place> fields_;  ///< row after row
  std::vector<int> line_of_row_;
  std::vector<std::size_t> ordinals_;
  std::size_t ordinal_count_ = 0;
  NumberForm numbers_;
  int header_line_ = 1;  ///< 0: none
};

}  // namespace tera
