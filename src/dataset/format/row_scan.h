#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"

namespace tera {

/// A valid row of a CSV file.
struct ScannedRow {
  int line = 0;
  TimeNs t_ns = 0;
  std::vector<double> values;  ///< without t_ns; empty in a list of frames
  std::string filename;        ///< in a list of frames
};

enum class RowFault {
  kCutOff,     ///< a last line without an end
  kFields,     ///< too few or many fields, or no number
  kNotFinite,  ///< NaN or infinity
  kStamp       ///< t_ns no greater than in the previous row
};

/// Reads a CSV file of a recording row by row, at any length. Times of the returned rows increase.
class RowScan {
 public:
  using OnFault = std::function<void(RowFault fault, int line, const std::string& what)>;

  /// Refuses faults. Throws InputError with file and line if the file cannot be read, and if its
  /// first line is no header or repeats a column. Next throws for a faulty row.
  explicit RowScan(const std::filesystem::path& file);
  /// Reports faulty rows and skips them.
  RowScan(const std::filesystem::path& file, OnFault on_fault);
  RowScan(const RowScan&) = delete;
  RowScan& operator=(const RowScan&) = delete;

  /// Without t_ns; only `filename` in a list of frames.
  const std::vector<std::string>& columns() const { return columns_; }
  bool lists_frames() const { return lists_frames_; }
  /// The next valid row; false at the end.
  bool Next(ScannedRow* row);
  /// Throws InputError about the last row of Next, or about the header before the first.
  [[noreturn]] void Fail(std::string_view finding) const;
  /// Throws InputError unless the columns are these, without t_ns; names the first missing one.
  void RequireColumns(const std::vector<std::string>& columns) const;

 private:
  bool Read(ScannedRow* row);
  bool Tell(RowFault fault, const std::string& what) const;

  std::filesystem::path file_;
  std::ifstream stream_;
  OnFault on_fault_;
  std::string text_;
  int line_ = 1;
  bool lists_frames_ = false;
  std::optional<TimeNs> before_ns_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;  ///< views into `text_`
};

}  // namespace tera
