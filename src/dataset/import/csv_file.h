#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

namespace tera {

/// A comma-separated file with a header line, in memory. Every fault is an InputError with
/// file:line, what was found and what is needed.
class CsvFile {
 public:
  enum class LastLine { kMustEnd, kMayLackItsEnd, kIsLeftOutIfCut };

  /// Reads the file. Faults: no header, a column named twice, a row with too few or too many
  /// fields, and with kMustEnd a last line that was cut off.
  CsvFile(const std::filesystem::path& path, LastLine last_line);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t row_count() const { return columns_.empty() ? 0 : fields_.size() / columns_.size(); }

  /// Index of a column. Throws for a missing one.
  std::size_t Column(const std::string& name) const;
  int Line(std::size_t row) const { return line_of_row_[row]; }
  std::string_view Field(std::size_t row, std::size_t column) const {
    return fields_[row * columns_.size() + column];
  }
  /// A finite number.
  double Number(std::size_t row, std::size_t column) const;
  /// A whole number of nanoseconds in the first column, greater than that of the row before.
  TimeNs Time(std::size_t row) const;
  [[noreturn]] void Fail(std::size_t row, std::size_t column, const std::string& finding) const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<const std::string> text_;  ///< apart, so that a moved file keeps its fields valid
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;  ///< into *text_, row after row
  std::vector<int> line_of_row_;
};

}  // namespace tera
