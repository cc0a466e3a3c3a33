#include "dataset/import/clocks/motion_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/motion.h"
#include "core/quantile.h"

namespace tera {
namespace {

constexpr TimeNs kLeastStep_ns = 5'000'000;
constexpr std::size_t kMostCells = 1'000'000, kFewestRows = 100;
constexpr TimeNs kLongestGap_ns = kNsPerSecond;
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// Half of the interval over which a receiver's velocity and course rate are computed.
constexpr TimeNs kHalfOfVelocity_ns = 250'000'000, kHalfOfCourse_ns = 500'000'000;
/// Below this speed, noise dominates the course of a receiver.
constexpr double kLeastSpeed_mps = 0.3;

/// Interpolates missing values linearly between neighbours at most `most_cells` apart.
void Bridge(std::size_t most_cells, std::vector<float>* values) {
  std::optional<std::size_t> before;
  for (std::size_t k = 0; k < values->size(); ++k) {
    if (std::isnan((*values)[k])) continue;
    if (before && k - *before > 1 && k - *before <= most_cells) {
      const float from = (*values)[*before], to = (*values)[k];
      for (std::size_t j = *before + 1; j < k; ++j) {
        const float share = static_cast<float>(j - *before) / static_cast<float>(k - *before);
        (*values)[j] = from + share * (to - from);
      }
    }
    before = k;
  }
}

/// Positions of a receiver that have a fix.
class FixTrack {
 public:
  explicit FixTrack(const std::vector<GnssSample>& samples) {
    for (const GnssSample& s : samples) {
      if (s.fix != GnssFix::kNone) fixes_.push_back(&s);
    }
  }

  std::optional<Vec2> VelocityAt(TimeNs t_ns) const {
    const auto from = At(t_ns - kHalfOfVelocity_ns), to = At(t_ns + kHalfOfVelocity_ns);
    if (!from || !to) return std::nullopt;
    return Vec2((*to - *from) / ToSeconds(2 * kHalfOfVelocity_ns));
  }

  double SpeedAt(TimeNs t_ns) const {
    const auto velocity = VelocityAt(t_ns);
    return velocity ? velocity->norm() : kNothing;
  }

  /// Turn rate of the course in rad/s.
  double CourseRateAt(TimeNs t_ns) const {
    const auto from = VelocityAt(t_ns - kHalfOfCourse_ns), to = VelocityAt(t_ns + kHalfOfCourse_ns);
    if (!from || !to || from->norm() < kLeastSpeed_mps || to->norm() < kLeastSpeed_mps) {
      return kNothing;
    }
    const double turned_rad = std::atan2(from->x() * to->y() - from->y() * to->x(), from->dot(*to));
    return turned_rad / ToSeconds(2 * kHalfOfCourse_ns);
  }

 private:
  std::optional<Vec2> At(TimeNs t_ns) const {
    const auto after = std::lower_bound(fixes_.begin(), fixes_.end(), t_ns,
                                        [](const GnssSample* s, TimeNs t) { return s->t_ns < t; });
    if (after == fixes_.end()) return std::nullopt;
    if ((*after)->t_ns == t_ns) return Vec2((*after)->enu_m.head<2>());
    if (after == fixes_.begin()) return std::nullopt;
    const GnssSample &a = **(after - 1), &b = **after;
    if (b.t_ns - a.t_ns > kLongestGap_ns) return std::nullopt;
    const double share = ToSeconds(t_ns - a.t_ns) / ToSeconds(b.t_ns - a.t_ns);
    return Vec2(a.enu_m.head<2>() + share * (b.enu_m - a.enu_m).head<2>());
  }

  std::vector<const GnssSample*> fixes_;
};

}  // namespace

MotionGrid::MotionGrid(std::size_t count, const std::function<TimeNs(std::size_t)>& time)
    : count_(count), time_(time) {
  if (count < kFewestRows) return;
  std::vector<TimeNs> intervals_ns;
  for (std::size_t i = 1; i < count; ++i) intervals_ns.push_back(time(i) - time(i - 1));
  interval_ns_ = Median(std::move(intervals_ns));
  first_ns_ = time(0);
  const TimeNs span_ns = time(count - 1) - first_ns_;
  step_ns_ = std::max({interval_ns_, kLeastStep_ns, span_ns / static_cast<TimeNs>(kMostCells) + 1});
  cells_ = static_cast<std::size_t>(span_ns / step_ns_) + 2;
}

MotionSeries MotionGrid::Series(const std::string& what, MotionKind kind,
                                const std::function<double(std::size_t)>& value) const {
  MotionSeries series{what, kind, first_ns_, step_ns_, 0, std::vector<float>(cells_, 0)};
  std::vector<std::uint16_t> counts(cells_, 0);
  for (std::size_t i = 0; i < count_; ++i) {
    const double v = value(i);
    if (!std::isfinite(v)) continue;
    const auto cell = static_cast<std::size_t>((time_(i) - first_ns_ + step_ns_ / 2) / step_ns_);
    series.values[cell] += static_cast<float>(v);
    ++counts[cell];
  }
  for (std::size_t k = 0; k < cells_; ++k) {
    series.values[k] = counts[k] > 0 ? series.values[k] / static_cast<float>(counts[k]) : kNothing;
  }
  const TimeNs gap_ns = std::max(kLongestGap_ns, 2 * interval_ns_);
  Bridge(static_cast<std::size_t>(gap_ns / step_ns_), &series.values);
  return series;
}

std::vector<MotionSeries> MotionOf(std::size_t count, const SampleOfRow<ImuSample>& sample) {
  const MotionGrid grid(count, [&](std::size_t i) { return sample(i).t_ns; });
  if (grid.empty()) return {};
  std::vector<MotionSeries> series;
  for (int axis = 0; axis < 3; ++axis) {
    series.push_back(grid.Series(std::string("w") + "xyz"[axis], MotionKind::kTurn,
                                 [&](std::size_t i) { return sample(i).w_WS_S_radps[axis]; }));
  }
  series.push_back(grid.Series("turn in all", MotionKind::kTurnSize,
                               [&](std::size_t i) { return sample(i).w_WS_S_radps.norm(); }));
  return series;
}

std::vector<MotionSeries> MotionOf(const std::vector<EncoderAxis>& axes,
                                   const std::vector<EncoderSample>& samples) {
  constexpr std::size_t kMostSummed = 6;  // joints; few machines have more
  const MotionGrid grid(samples.size(), [&](std::size_t i) { return samples[i].t_ns; });
  if (grid.empty()) return {};
  std::vector<MotionSeries> series;
  for (std::size_t from = 0; from < axes.size(); ++from) {
    std::string what;
    for (std::size_t to = from; to < axes.size() && !axes[to].linear; ++to) {
      if (to > from && axes.size() > kMostSummed) break;
      what += (what.empty() ? "" : " + ") + axes[to].name;
      const auto rate = [&](std::size_t i) {
        double sum = 0;
        for (std::size_t j = from; j <= to; ++j) sum += samples[i].qd_radps[j];
        return sum;
      };
      series.push_back(grid.Series(what, MotionKind::kTurn, rate));
      if (to > from) continue;
      const auto size = [&](std::size_t i) { return std::abs(rate(i)); };
      series.push_back(grid.Series(what, MotionKind::kTurnSize, size));
      series.push_back(grid.Series(what, MotionKind::kSpeedSize, size));
    }
  }
  return series;
}

std::vector<MotionSeries> MotionOf(const std::vector<GnssSample>& samples) {
  const MotionGrid grid(samples.size(), [&](std::size_t i) { return samples[i].t_ns; });
  if (grid.empty()) return {};
  const FixTrack track(samples);
  MotionSeries speed = grid.Series("speed", MotionKind::kSpeedSize,
                                   [&](std::size_t i) { return track.SpeedAt(samples[i].t_ns); });
  speed.averaged_s = ToSeconds(2 * kHalfOfVelocity_ns);
  MotionSeries course = grid.Series("course rate", MotionKind::kTurn, [&](std::size_t i) {
    return track.CourseRateAt(samples[i].t_ns);
  });
  course.averaged_s = ToSeconds(2 * kHalfOfCourse_ns);
  return {std::move(speed), std::move(course)};
}

std::vector<MotionSeries> MotionOf(std::size_t count, const SampleOfRow<TruthPose>& pose) {
  const MotionGrid grid(count, [&](std::size_t i) { return pose(i).t_ns; });
  if (grid.empty()) return {};
  const auto between = [&](std::size_t i, const auto& value) -> double {
    if (i == 0 || i + 1 == count) return kNothing;
    const TruthPose a = pose(i - 1), b = pose(i + 1);
    return value(a.X_WB, b.X_WB) / ToSeconds(b.t_ns - a.t_ns);
  };
  const auto turn_W_rad = [](const Pose& a, const Pose& b) {
    const Eigen::AngleAxisd turn(b.linear() * a.linear().transpose());
    return Vec3(turn.angle() * turn.axis());
  };
  const auto moved_m = [](const Pose& a, const Pose& b) {
    return (b.translation() - a.translation()).norm();
  };
  return {grid.Series("speed", MotionKind::kSpeedSize,
                      [&](std::size_t i) { return between(i, moved_m); }),
          grid.Series("yaw rate", MotionKind::kTurn,
                      [&](std::size_t i) {
                        return between(
                            i, [&](const Pose& a, const Pose& b) { return turn_W_rad(a, b).z(); });
                      }),
          grid.Series("turn in all", MotionKind::kTurnSize, [&](std::size_t i) {
            return between(i,
                           [&](const Pose& a, const Pose& b) { return turn_W_rad(a, b).norm(); });
          })};
}

}  // namespace tera
