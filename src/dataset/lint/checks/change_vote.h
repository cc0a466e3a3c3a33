#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dataset/format/row_scan.h"
#include "dataset/lint/lint_job.h"

namespace tera {

/// All rows of a channel without fault.
struct ScannedTable {
  std::vector<std::string> columns;
  std::vector<ScannedRow> rows;
};
ScannedTable ReadTable(const LintJob& job, const std::string& channel);

/// First and last row of a window.
using RowWindow = std::pair<std::size_t, std::size_t>;

/// Length of a window: long enough for noise to average out, short enough for a machine to turn by
/// less than half a revolution in it.
inline constexpr TimeNs kWindow_ns = kNsPerSecond / 2;

/// Windows of kWindow_ns one after the other, without those in which rows are missing for half of
/// it.
std::vector<RowWindow> WindowsOf(const std::vector<ScannedRow>& rows);

/// Two accounts of the same changes, window by window.
///
/// Model  a window counts where either account changes by more than twice `floor`; it is
///        contradicted where the two differ by more than `floor` and kShare of the larger change.
///        The accounts contradict each other where more than half of the windows that count are,
///        so that slip, shocks and single jumps do not decide.
class ChangeVote {
 public:
  explicit ChangeVote(double floor) : floor_(floor) {}

  /// Sizes of the changes and of their difference; `line` is that of the window's last row.
  void Add(int line, double first, double second, double difference);
  bool IsContradicted() const { return 2 * contradicted_ > counted_; }
  /// Of the first window that is contradicted.
  int line() const { return line_; }
  /// What it is that contradicts; `first` and `second` name the accounts.
  std::string Summary(std::string_view first, std::string_view second, std::string_view unit) const;

 private:
  static constexpr double kShare = 0.3;

  double floor_;
  int counted_ = 0, contradicted_ = 0, line_ = 0;
  double first_ = 0, second_ = 0;  ///< sums over contradicted windows
};

}  // namespace tera
