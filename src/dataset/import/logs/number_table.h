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

/// Rows of numbers in memory, each with its time in the column `time`, as readers of logs fill it.
class NumberTable final : public RowTable {
 public:
  NumberTable(std::filesystem::path file, std::vector<std::string> columns);

  struct Cell {
    std::string_view column;
    double value = 0;
  };
  /// Columns that are not among `cells` are empty in the row. Numbers that are not finite too.
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
  std::vector<std::string> names_;  ///< `time` first
  std::map<std::string, std::size_t, std::less<>> place_of_;
  std::vector<int> lines_;
  std::vector<TimeNs> t_ns_;
  std::vector<double> numbers_;  ///< row after row, without the time; NaN: none
};

/// Lines of a text file, one after the other, whatever its length.
class LogLines {
 public:
  /// The length of the binary frame that bytes begin with, or 0.
  using FrameBytes = std::size_t (*)(std::string_view bytes);

  /// Frames that stand before, between and behind lines are passed over; their first byte is none
  /// of ASCII's.
  explicit LogLines(const std::filesystem::path& file, FrameBytes frame_bytes = nullptr);

  /// Without its end. False at the end of the file.
  bool Next(std::string* line);
  int number() const { return number_; }
  const std::filesystem::path& file() const { return file_; }
  /// An InputError about the line that Next gave last; with `left_out` counted there instead.
  void Fault(const std::string& finding, LeftOutRows* left_out) const;

 private:
  /// Where a line ends that begins at `at_`: at its end, or where a frame begins.
  std::size_t EndOfLine() const;

  std::filesystem::path file_;
  std::string text_;
  FrameBytes frame_bytes_;
  std::size_t at_ = 0;
  int number_ = 0, ended_ = 0;  ///< of the line that Next gave; of line ends before `at_`
};

/// A finite number that makes up the whole of a text.
std::optional<double> WholeNumber(std::string_view text);

/// Fields between separators; of blanks any number is one.
std::vector<std::string_view> FieldsOf(std::string_view line, char separator);

}  // namespace tera
