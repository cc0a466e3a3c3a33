#include "diagnose/tolerances/lever_interval.h"

#include <vector>

#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kLeastRepeats = 0.05;

}  // namespace

double LeverInterval_s(const TableRecording& levers) {
  std::vector<double> intervals_s;
  double repeats = 0;
  for (std::size_t k = 1; k < levers.t_ns.size(); ++k) {
    intervals_s.push_back(ToSeconds(levers.t_ns[k] - levers.t_ns[k - 1]));
    repeats += levers.rows[k] == levers.rows[k - 1] ? 1 : 0;
  }
  if (repeats < kLeastRepeats * static_cast<double>(intervals_s.size())) return 0;
  return intervals_s.empty() ? 0 : Median(intervals_s);
}

}  // namespace tera
