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

/// Syntax of a text table.
struct CsvForm {
  char separator = 0;  ///< 0: the first of tab, semicolon, bar, comma and blank that occurs in the
                       ///< first line
  bool has_header = true;  ///< false: columns are named "1", "2" and so on
  int skipped_lines = 0;   ///< lines before the header, or before the first row
  int unit_lines = 0;      ///< non-empty lines between header and first row, such as units
  /// First and last line that may hold rows; 0: no limit.
  int first_line = 0, last_line = 0;
  NumberForm numbers;
};

/// Reads one table, or several tables with equal columns one after another. Throws InputError if
/// the columns differ, and for the faults of CsvFile.
std::unique_ptr<const RowTable> ReadTextTables(const std::vector<std::filesystem::path>& files,
                                               const CsvForm& form, LeftOutRows* left_out);

/// A text table in memory. A fault throws InputError with file, line, found content and required
/// content.
class CsvFile final : public RowTable {
 public:
  /// Reads the file with DecodedTable. Accepts quoted fields, blanks around fields, empty lines,
  /// comment lines that begin with '#' or '%', separators at the end of rows, and a last line
  /// without an end. A column without a name is named by its number; the k-th column of a repeated
  /// name is "NAME#k". A row with too few or too many fields is a fault, or is added to `left_out`
  /// if given.
  CsvFile(const std::filesystem::path& path, const CsvForm& form, LeftOutRows* left_out);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t row_count() const override {
    return columns_.empty() ? 0 : fields_.size() / columns_.size();
  }

  std::size_t Column(const std::string& name) const override;
  int Line(std::size_t row) const override { return line_of_row_[row]; }
  std::size_t Ordinal(std::size_t row) const override { return ordinals_[row]; }
  /// Number of rows, including those left out.
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
  /// Position of a field in the text. It has half the size of a string_view, because tables have up
  /// to 1e8 fields.
  struct Place {
    std::uint64_t begin : 40, bytes : 24;
  };

  void NameColumns(const std::vector<std::string_view>& names);
  void ReadRows(std::string_view rest, const CsvForm& form, LeftOutRows* left_out);
  /// Removes empty fields at the end of a row that has surplus separators.
  void DropEmptyEnd(std::vector<std::string_view>* fields) const;
  std::string WrongFieldCount(std::size_t found, bool is_last) const;
  [[noreturn]] void FailAtLine(int line, const InputFault& fault) const;
  void AddRow(const std::vector<std::string_view>& fields, int line);

  std::filesystem::path path_;
  std::unique_ptr<const std::string>
      text_;  ///< on the heap, so that views stay valid when the object is moved
  std::vector<std::string> columns_;
  std::vector<Place> fields_;  ///< row by row
  std::vector<int> line_of_row_;
  std::vector<std::size_t> ordinals_;
  std::size_t ordinal_count_ = 0;
  NumberForm numbers_;
  int header_line_ = 1;  ///< 0: no header
};

}  // namespace tera
