#include "dataset/lint/checks/change_vote.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {

ScannedTable ReadTable(const LintJob& job, const std::string& channel) {
  RowScan scan(job.Path(job.RowsOf(channel)), {});
  ScannedTable table{scan.columns(), {}};
  for (ScannedRow row; scan.Next(&row);) table.rows.push_back(row);
  return table;
}

std::vector<RowWindow> WindowsOf(const std::vector<ScannedRow>& rows) {
  std::vector<RowWindow> windows;
  std::size_t first = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (2 * (rows[i].t_ns - rows[i - 1].t_ns) > kWindow_ns) first = i;
    if (rows[i].t_ns - rows[first].t_ns < kWindow_ns) continue;
    windows.emplace_back(first, i);
    first = i;
  }
  return windows;
}

void ChangeVote::Add(int line, double first, double second, double difference) {
  const double larger = std::max(first, second);
  if (larger <= 2 * floor_) return;
  ++counted_;
  if (difference <= floor_ + kShare * larger) return;
  if (contradicted_ == 0) line_ = line;
  ++contradicted_;
  first_ += first;
  second_ += second;
}

std::string ChangeVote::Summary(std::string_view first, std::string_view second,
                                std::string_view unit) const {
  constexpr double kNearDegrees = 0.1;
  const double n = contradicted_;
  std::string text = fmt::format(
      "in {} of {} windows of {} s: on average {:.4g} {} by {}, {:.4g} {} by {}", contradicted_,
      counted_, ToSeconds(kWindow_ns), first_ / n, unit, first, second_ / n, unit, second);
  const double ratio = first_ > 0 ? second_ / first_ : 0;
  if (std::abs(ratio * kDeg - 1) < kNearDegrees) text += ", as if they were degrees";
  if (std::abs(ratio / kDeg - 1) < kNearDegrees) text += ", as if the others were degrees";
  return text;
}

}  // namespace tera
