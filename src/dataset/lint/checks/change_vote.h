#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dataset/format/row_scan.h"
#include "dataset/lint/lint_job.h"

namespace tera {

struct ScannedTable {
  std::vector<std::string> columns;
  std::vector<ScannedRow> rows;
};
ScannedTable ReadTable(const LintJob& job, const std::string& channel);

/// Indices of the first and last row of a window.
using RowWindow = std::pair<std::size_t, std::size_t>;

/// Length of a window: long enough to average noise, and short enough that no machine turns by half
/// a revolution.
inline constexpr TimeNs kWindow_ns = kNsPerSecond / 2;

/// Consecutive windows of kWindow_ns. Windows in which rows are missing for half of the time are
/// skipped.
std::vector<RowWindow> WindowsOf(const std::vector<ScannedRow>& rows);

/// Compares two measurements of the same changes, window by window, and takes a majority vote.
///
/// Model   A window counts if either measurement changes by more than twice `floor`. It is
///         contradicted if the measurements differ by more than `floor` and by more than the
///         fraction kShare of the larger change. The measurements contradict each other if more
///         than half of the counted windows are contradicted. Thus slip, shocks and single jumps do
///         not decide.
class ChangeVote {
 public:
  explicit ChangeVote(double floor) : floor_(floor) {}

  /// Adds a window: magnitudes of both changes and of their difference. `line` is the last line of
  /// the window.
  void Add(int line, double first, double second, double difference);
  bool IsContradicted() const { return 2 * contradicted_ > counted_; }
  int line() const { return line_; }
  /// Text that describes the contradiction; `first` and `second` name the measurements.
  std::string Summary(std::string_view first, std::string_view second, std::string_view unit) const;

 private:
  static constexpr double kShare = 0.3;

  double floor_;
  int counted_ = 0, contradicted_ = 0, line_ = 0;
  double first_ = 0, second_ = 0;  ///< sums over the contradicted windows
};

}  // namespace tera
