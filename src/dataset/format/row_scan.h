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

struct ScannedRow {
  int line = 0;
  TimeNs t_ns = 0;
  std::vector<double> values;  ///< without t_ns; empty in a frame list
  std::string filename;        ///< only in a frame list
};

enum class RowFault {
  kCutOff,     ///< the last line has no line end
  kFields,     ///< too few or too many fields, or a field that is not a number
  kNotFinite,  ///< NaN or infinity
  kStamp       ///< t_ns is not greater than in the previous row
};

/// Reads a CSV file of a recording row by row in constant memory. The times of the returned rows
/// increase.
class RowScan {
 public:
  using OnFault = std::function<void(RowFault fault, int line, const std::string& what)>;

  /// Strict mode: Next throws InputError for a faulty row. The constructor throws InputError with
  /// file and line if the file cannot be read, has no header or has a repeated column.
  explicit RowScan(const std::filesystem::path& file);
  /// Tolerant mode: a faulty row is passed to `on_fault` and skipped.
  RowScan(const std::filesystem::path& file, OnFault on_fault);
  RowScan(const RowScan&) = delete;
  RowScan& operator=(const RowScan&) = delete;

  /// Column names without t_ns. A frame list has only the column `filename`.
  const std::vector<std::string>& columns() const { return columns_; }
  bool lists_frames() const { return lists_frames_; }
  /// Reads the next valid row; returns false at the end.
  bool Next(ScannedRow* row);
  /// Throws InputError that names the last row of Next, or the header if no row has been read.
  [[noreturn]] void Fail(std::string_view finding) const;
  /// Throws InputError unless the columns after t_ns are `columns`. The message names the first
  /// missing column.
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
