#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dataset/format/row_scan.h"
#include "dataset/lint/lint_job.h"

namespace tera {

/// All valid rows of a channel.
struct ScannedTable {
  std::vector<std::string> columns;
  std::vector<ScannedRow> rows;
};
ScannedTable ReadTable(const LintJob& job, const std::string& channel);

/// First and last row of a window.
using RowWindow = std::pair<std::size_t, std::size_t>;

/// Length of a window: long enough to average noise, short enough that a machine turns by less than
/// half a revolution.
inline constexpr TimeNs kWindow_ns = kNsPerSecond / 2;

/// Consecutive windows of kWindow_ns, without those with rows missing for half of it.
std::vector<RowWindow> WindowsOf(const std::vector<ScannedRow>& rows);

/// Compares two sources of the same changes, window by window.
///
/// Model   a window counts if either source changes by more than twice `floor`. It is contradicted
///         if the two differ by more than `floor` and by more than kShare of the larger change. The
///         sources contradict each other if more than half of the counting windows are
///         contradicted, so that slip, shocks and single jumps do not decide.
class ChangeVote {
 public:
  explicit ChangeVote(double floor) : floor_(floor) {}

  /// Magnitudes of the changes and of their difference; `line` is that of the window's last row.
  void Add(int line, double first, double second, double difference);
  bool IsContradicted() const { return 2 * contradicted_ > counted_; }
  /// Line of the first contradicted window.
  int line() const { return line_; }
  /// Text of the contradiction; `first` and `second` name the sources.
  std::string Summary(std::string_view first, std::string_view second, std::string_view unit) const;

 private:
  static constexpr double kShare = 0.3;

  double floor_;
  int counted_ = 0, contradicted_ = 0, line_ = 0;
  double first_ = 0, second_ = 0;  ///< sums over contradicted windows
};

}  // namespace tera
