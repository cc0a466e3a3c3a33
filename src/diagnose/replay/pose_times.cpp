#include "diagnose/replay/pose_times.h"

#include <algorithm>
#include <cmath>

#include "core/motion.h"
#include "diagnose/statistics/robust.h"

namespace tera {
namespace {

constexpr std::size_t kNeighbours = 7;  ///< on either side
constexpr double kSteady = 0.25;        ///< by which they may differ from one side to the other
constexpr double kWhole = 0.3;          ///< from a whole number of times
constexpr double kMoves_m = 0.02;       ///< less is rest, or noise
constexpr double kPerRad_m = 1;

/// How far each pose is from the one before it.
std::vector<double> StepsOf_m(const std::vector<TruthPose>& poses) {
  std::vector<double> steps_m;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const Pose X_AB = poses[k - 1].X_WB.inverse() * poses[k].X_WB;
    const double turned_rad = Eigen::AngleAxisd(X_AB.linear()).angle();
    steps_m.push_back(std::hypot(X_AB.translation().norm(), kPerRad_m * turned_rad));
  }
  return steps_m;
}

/// How many periods each step took.
std::vector<TimeNs> PeriodsOf(const std::vector<double>& steps_m) {
  std::vector<TimeNs> periods(steps_m.size(), 1);
  for (std::size_t k = kNeighbours; k + kNeighbours < steps_m.size(); ++k) {
    const auto at = steps_m.begin() + static_cast<std::ptrdiff_t>(k);
    const auto neighbours = static_cast<std::ptrdiff_t>(kNeighbours);
    const double before_m = Median({at - neighbours, at});
    const double after_m = Median({at + 1, at + 1 + neighbours});
    if (std::min(before_m, after_m) < kMoves_m) continue;
    if (std::abs(before_m - after_m) > kSteady * std::max(before_m, after_m)) continue;
    const double times = 2 * *at / (before_m + after_m);
    if (times > 1.5 && std::abs(times - std::round(times)) < kWhole) {
      periods[k] = std::llround(times);
    }
  }
  return periods;
}

}  // namespace

std::optional<PoseTimes> TimesOfArrivals(const std::vector<TruthPose>& poses) {
  if (poses.size() < 3) return std::nullopt;
  std::vector<double> apart_s;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    apart_s.push_back(ToSeconds(poses[k].t_ns - poses[k - 1].t_ns));
  }
  PoseTimes times{Median(std::move(apart_s)), {}};
  const TimeNs period_ns = FromSeconds(times.period_s);
  const std::vector<TimeNs> periods = PeriodsOf(StepsOf_m(poses));
  times.t_ns.resize(poses.size());
  times.t_ns.back() = poses.back().t_ns;
  TimeNs longest_ns = 0;
  for (std::size_t k = poses.size() - 1; k-- > 0;) {
    times.t_ns[k] = std::min(poses[k].t_ns, times.t_ns[k + 1] - periods[k] * period_ns);
    longest_ns = std::max(longest_ns, poses[k].t_ns - times.t_ns[k]);
  }
  if (longest_ns <= period_ns) return std::nullopt;
  return times;
}

std::vector<TruthPose> AtTimes(std::vector<TruthPose> poses, const PoseTimes& times) {
  for (std::size_t k = 0; k < poses.size(); ++k) poses[k].t_ns = times.t_ns[k];
  return poses;
}

}  // namespace tera
