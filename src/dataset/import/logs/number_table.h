#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/import/left_out_rows.h"
#include "dataset/import/row_table.h"

namespace tera {

/// Rows of numbers in memory, filled by the readers of logs. The column `time` holds their times.
class NumberTable final : public RowTable {
 public:
  NumberTable(std::filesystem::path file, std::vector<std::string> columns);

  struct Cell {
    std::string_view column;
    double value = 0;
  };
  /// Adds a row. A column is empty if it is not in `cells` or its number is not finite.
  void AddRow(int line, TimeNs t_ns, const std::vector<Cell>& cells);

  std::size_t row_count() const override { return lines_.size(); }
  std::size_t Column(const std::string& name) const override;
  int Line(std::size_t row) const override { return lines_[row]; }
  std::optional<double> NumberIfAny(std::size_t row, std::size_t column) const override;
  double Number(std::size_t row, std::size_t column) const override;
  std::optional<TimeNs> Stamp(std::size_t row, std::size_t column) const override;
  bool IsPresent(std::size_t row, std::size_t column) const override;
  bool Repeats(std::size_t row, std::size_t column) const override;
  [[noreturn]] void Fail(std::size_t row, std::size_t column,
                         const InputFault& fault) const override;

 private:
  std::filesystem::path file_;
  std::vector<std::string> names_;  ///< `time` is first
  std::map<std::string, std::size_t, std::less<>> place_of_;
  std::vector<int> lines_;
  std::vector<TimeNs> t_ns_;
  std::vector<double> numbers_;  ///< row by row, without the time; NaN: empty
};

/// Reads a text file line by line; its size is unlimited.
class LogLines {
 public:
  /// Returns the length of a binary frame at the beginning of `bytes`, or 0.
  using FrameBytes = std::size_t (*)(std::string_view bytes);

  /// Skips binary frames before, between and after lines. Such a frame begins with a byte that is
  /// not ASCII.
  explicit LogLines(const std::filesystem::path& file, FrameBytes frame_bytes = nullptr);

  /// Reads the next line without its line end; returns false at the end of the file.
  bool Next(std::string* line);
  int number() const { return number_; }
  const std::filesystem::path& file() const { return file_; }
  /// Throws InputError about the last line. With `left_out`, counts the line there instead.
  void Fault(const std::string& finding, LeftOutRows* left_out) const;

 private:
  /// Offset where the line at `at_` ends: at its line end or at the start of a binary frame.
  std::size_t EndOfLine() const;

  std::filesystem::path file_;
  std::string text_;
  FrameBytes frame_bytes_;
  std::size_t at_ = 0;
  int number_ = 0, ended_ = 0;  ///< number of the last line; number of line ends before `at_`
};

/// Parses the whole text as a finite number.
std::optional<double> WholeNumber(std::string_view text);

/// Fields between separators. With a blank as separator, several blanks in a row count as one.
std::vector<std::string_view> FieldsOf(std::string_view line, char separator);

}  // namespace tera
