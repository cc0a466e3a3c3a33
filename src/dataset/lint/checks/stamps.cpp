#include "dataset/lint/checks/stamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/quantile.h"

namespace tera {
namespace {

/// An interval closer to two periods than to one means that a row is missing.
constexpr double kGapPeriods = 1.5;
/// Real clocks deviate by about 1e-4, and imported rates are written with six digits. A wrong rate
/// or unit deviates much more.
constexpr double kRateTolerance = 0.05;
/// A table without a stated rate counts as regular if this fraction of its intervals is within
/// kRegularTolerance of the median. Other tables have rows only at changes.
constexpr double kRegularShare = 0.9, kRegularTolerance = 0.1;
/// Allowed margin at both ends of a recording, in periods. The first row of an averaging sensor is
/// one period late. For a real recording the margin is a fraction of its length.
constexpr double kSparePeriods = 2, kSpareShare = 0.1;
/// With fewer intervals, the rate is not checked.
constexpr std::size_t kFewestIntervals = 4;

std::vector<TimeNs> IntervalsOf(const StampScan& stamps) {
  std::vector<TimeNs> intervals;
  for (std::size_t i = 1; i < stamps.t_ns.size(); ++i) {
    intervals.push_back(stamps.t_ns[i] - stamps.t_ns[i - 1]);
  }
  return intervals;
}

bool IsRegular(const std::vector<TimeNs>& intervals, TimeNs median_ns) {
  const auto near = std::count_if(intervals.begin(), intervals.end(), [&](TimeNs interval) {
    return std::abs(static_cast<double>(interval - median_ns)) <=
           kRegularTolerance * static_cast<double>(median_ns);
  });
  return static_cast<double>(near) >= kRegularShare * static_cast<double>(intervals.size());
}

/// Returns false if the stamps have another rate than sensor.yaml.
bool CheckRate(LintJob* job, const std::string& channel, double rate_hz, TimeNs median_ns) {
  job->Applies("stamps.rate");
  const double found_hz = 1 / ToSeconds(median_ns);
  if (std::abs(found_hz - rate_hz) <= kRateTolerance * rate_hz) return true;
  job->Find("stamps.rate", channel,
            {job->RowsOf(channel), 0,
             fmt::format("the median interval gives {:.4g} Hz, sensor.yaml gives {:.4g} Hz",
                         found_hz, rate_hz)});
  return false;
}

void CheckGaps(LintJob* job, const std::string& channel, const StampScan& stamps, double period_s) {
  job->Applies("stamps.gap");
  for (std::size_t i = 1; i < stamps.t_ns.size(); ++i) {
    const double interval_s = ToSeconds(stamps.t_ns[i] - stamps.t_ns[i - 1]);
    const bool is_behind_fault =
        stamps.lines[i] != stamps.lines[i - 1] + 1;  // follows an invalid row
    if (interval_s <= kGapPeriods * period_s || is_behind_fault) continue;
    job->Find("stamps.gap", channel,
              {job->RowsOf(channel), stamps.lines[i],
               fmt::format("{:.4g} s after the row before, need {:.4g} s", interval_s, period_s)});
  }
}

void CheckCoverage(LintJob* job, const std::string& channel, const StampScan& stamps,
                   double period_s) {
  const DatasetInfo& info = job->recording().info();
  const double spare_s = kSparePeriods * period_s;
  if (info.duration_s <= spare_s) return;  // too short to require a row
  job->Applies("stamps.coverage");
  const auto find = [&](int line, const std::string& what) {
    job->Find("stamps.coverage", channel, {job->RowsOf(channel), line, what});
  };
  if (stamps.t_ns.empty()) {
    find(1, fmt::format("has no rows in {} s", info.duration_s));
    return;
  }
  const double first_s = ToSeconds(stamps.t_ns.front()), last_s = ToSeconds(stamps.t_ns.back());
  // Times of a real recording need not start at 0, so only the length of the span is checked.
  const double begin_s = info.simulated ? 0 : first_s;
  if (first_s < begin_s - spare_s || last_s > begin_s + info.duration_s + spare_s) {
    find(stamps.lines.back(),
         fmt::format("runs from {:.4g} s to {:.4g} s, the recording lasts {:.4g} s", first_s,
                     last_s, info.duration_s));
  }
  if (last_s - first_s < (1 - kSpareShare) * info.duration_s - spare_s) {
    find(stamps.lines.back(), fmt::format("spans {:.4g} s of the recording's {:.4g} s",
                                          last_s - first_s, info.duration_s));
  }
}

void Tell(LintJob* job, const std::string& channel, const StampScan& stamps,
          const std::vector<TimeNs>& intervals) {
  ChannelStatistics& told = job->statistics().channels[channel];
  told.type = job->recording().TypeOf(channel);
  told.rows = static_cast<std::int64_t>(stamps.t_ns.size());
  if (stamps.t_ns.empty()) return;
  told.first_ns = stamps.t_ns.front();
  told.last_ns = stamps.t_ns.back();
  if (!intervals.empty()) {
    told.median_interval_ns = Median(intervals);
    told.longest_interval_ns = *std::max_element(intervals.begin(), intervals.end());
  }
}

}  // namespace

void CheckStamps(LintJob* job, const std::string& channel, const StampScan& stamps) {
  const std::vector<TimeNs> intervals = IntervalsOf(stamps);
  Tell(job, channel, stamps, intervals);
  const TimeNs median_ns = intervals.empty() ? 0 : Median(intervals);
  const bool enough = intervals.size() >= kFewestIntervals;
  const bool is_sensor = job->RowsOf(channel) != channel;
  const std::optional<SensorSheet> sheet = is_sensor ? job->SheetOf(channel) : std::nullopt;
  double period_s = ToSeconds(median_ns);
  bool is_periodic = enough && IsRegular(intervals, median_ns);
  if (sheet && sheet->rate_hz > 0) {
    const bool agrees = !enough || CheckRate(job, channel, sheet->rate_hz, median_ns);
    if (agrees) period_s = 1 / sheet->rate_hz;
    is_periodic = is_periodic || agrees;
  }
  if (is_periodic) CheckGaps(job, channel, stamps, period_s);
  if (period_s > 0) CheckCoverage(job, channel, stamps, period_s);
}

}  // namespace tera
