#include "diagnose/replay/pose_times.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/motion.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr std::size_t kNeighbours = 7;  ///< steps on either side for comparison
/// Between the steps on both sides, relative to the larger.
constexpr double kMostSideDifference = 0.25;
constexpr double kMostFromWhole = 0.3;  ///< distance of a ratio of steps from a whole number
constexpr double kLeastStep_m = 0.02;   ///< shorter steps are rest or noise
constexpr double kPerRad_m = 1;         ///< about the radius of a machine's outline
/// Intervals of stamps within this relative deviation from the median determine the period.
constexpr double kUsualDeviation = 0.25;
constexpr double kPeriodUncertainty = 0.01;  ///< relative to the period
/// Wait of the latest pose, in periods, that shows arrival stamps.
constexpr TimeNs kLeastWait = 2;
constexpr std::size_t kLongestQueue = 50;  ///< largest number of waiting poses

/// Distance of each pose from the previous one.
std::vector<double> StepsOf_m(const std::vector<TruthPose>& poses) {
  std::vector<double> steps_m;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const Pose X_AB = poses[k - 1].X_WB.inverse() * poses[k].X_WB;
    const double turned_rad = Eigen::AngleAxisd(X_AB.linear()).angle();
    steps_m.push_back(std::hypot(X_AB.translation().norm(), kPerRad_m * turned_rad));
  }
  return steps_m;
}

/// Length of each step relative to its neighbours, as a whole number. 1 if it is not near a whole
/// number.
std::vector<TimeNs> TimesAsFar(const std::vector<double>& steps_m) {
  std::vector<TimeNs> times(steps_m.size(), 1);
  for (std::size_t k = kNeighbours; k + kNeighbours < steps_m.size(); ++k) {
    const auto at = steps_m.begin() + static_cast<std::ptrdiff_t>(k);
    const auto neighbours = static_cast<std::ptrdiff_t>(kNeighbours);
    const double before_m = Median(std::vector<double>(at - neighbours, at));
    const double after_m = Median(std::vector<double>(at + 1, at + 1 + neighbours));
    if (std::min(before_m, after_m) < kLeastStep_m) continue;
    if (std::abs(before_m - after_m) > kMostSideDifference * std::max(before_m, after_m)) continue;
    const double far = 2 * *at / (before_m + after_m);
    if (far > 1.5 && std::abs(far - std::round(far)) < kMostFromWhole) times[k] = std::llround(far);
  }
  return times;
}

TimeNs PeriodOf(const std::vector<TruthPose>& poses) {
  std::vector<double> apart_s;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    apart_s.push_back(ToSeconds(poses[k].t_ns - poses[k - 1].t_ns));
  }
  const double median_s = Median(apart_s);
  double sum_s = 0, count = 0;
  for (const double one_s : apart_s) {
    if (std::abs(one_s - median_s) > kUsualDeviation * median_s) continue;
    sum_s += one_s;
    ++count;
  }
  return FromSeconds((1 - kPeriodUncertainty) * sum_s / count);
}

/// True if the previous poses arrived late enough to have queued before this one. Otherwise this
/// pose is late for another reason.
bool HasRoom(const std::vector<TruthPose>& poses, std::size_t pose, TimeNs waits_ns,
             TimeNs period_ns) {
  for (std::size_t k = pose; k > 0 && pose - k < kLongestQueue; --k) {
    waits_ns += period_ns - (poses[k].t_ns - poses[k - 1].t_ns);
    if (waits_ns <= 0) return true;
  }
  return false;
}

}  // namespace

std::optional<PoseTimes> TimesOfArrivals(const std::vector<TruthPose>& poses) {
  if (poses.size() < 3) return std::nullopt;
  const TimeNs period_ns = PeriodOf(poses);
  const std::vector<TimeNs> times_as_far = TimesAsFar(StepsOf_m(poses));
  PoseTimes times_ns(poses.size());
  times_ns.back() = poses.back().t_ns;
  TimeNs longest_ns = 0;
  for (std::size_t k = poses.size() - 1; k-- > 0;) {
    const TimeNs lost_ns = (times_as_far[k] - 1) * period_ns;
    const TimeNs latest_ns = std::min(poses[k].t_ns, times_ns[k + 1] - period_ns);
    const TimeNs waits_ns =
        std::max<TimeNs>(0, poses[k].t_ns - times_ns[k + 1] + period_ns + lost_ns);
    const bool is_lost = lost_ns > 0 && HasRoom(poses, k, waits_ns, period_ns);
    times_ns[k] = is_lost ? poses[k].t_ns - waits_ns : latest_ns;
    longest_ns = std::max(longest_ns, poses[k].t_ns - times_ns[k]);
  }
  if (longest_ns <= kLeastWait * period_ns) return std::nullopt;
  return times_ns;
}

std::vector<TruthPose> AtTimes(std::vector<TruthPose> poses, const PoseTimes& times_ns) {
  TERA_CHECK(poses.size() == times_ns.size(), poses.size(), times_ns.size());
  for (std::size_t k = 0; k < poses.size(); ++k) poses[k].t_ns = times_ns[k];
  return poses;
}

}  // namespace tera
