#include "dataset/compare/trajectory_error.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"

namespace tera {
namespace {

constexpr std::size_t kMinPairs = 3;

/// Both poses at a time of the reference.
struct Pair {
  TimeNs t_ns;
  Pose a, b;
};

std::vector<Pair> Associate(const Trajectory& a, const Trajectory& b, TimeNs max_gap_ns) {
  std::vector<Pair> pairs;
  for (const TimedPose& pose : a) {
    if (const auto other = PoseAt(b, pose.t_ns, max_gap_ns)) {
      pairs.push_back({pose.t_ns, pose.X_WB, *other});
    }
  }
  return pairs;
}

/// Least-squares rigid motion from the positions of b to those of a.
Pose FitSe3(const std::vector<Pair>& pairs) {
  Eigen::Matrix3Xd from(3, pairs.size()), to(3, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = pairs[i].b.translation();
    to.col(static_cast<Eigen::Index>(i)) = pairs[i].a.translation();
  }
  Pose X_WV = Pose::Identity();
  X_WV.matrix() = Eigen::umeyama(from, to, false);
  return X_WV;
}

/// Least-squares motion in the horizontal plane, in closed form: tan(yaw) is the sum of cross
/// products divided by the sum of dot products of the centred positions. Heights do not change.
Pose FitSe2(const std::vector<Pair>& pairs) {
  const auto n = static_cast<double>(pairs.size());
  Vec2 centre_a = Vec2::Zero(), centre_b = Vec2::Zero();
  for (const Pair& p : pairs) {
    centre_a += p.a.translation().head<2>() / n;
    centre_b += p.b.translation().head<2>() / n;
  }
  double cross = 0, dot = 0;
  for (const Pair& p : pairs) {
    const Vec2 a = p.a.translation().head<2>() - centre_a;
    const Vec2 b = p.b.translation().head<2>() - centre_b;
    cross += b.x() * a.y() - b.y() * a.x();
    dot += b.dot(a);
  }
  const Pose turn = MakePose(Vec3::Zero(), 0, 0, std::atan2(cross, dot));
  const Vec3 shift =
      Vec3(centre_a.x(), centre_a.y(), 0) - turn.linear() * Vec3(centre_b.x(), centre_b.y(), 0);
  return MakePose(shift, turn.linear());
}

Pose Align(const std::vector<Pair>& pairs, Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return Pose::Identity();
    case Alignment::kSe2:
      return FitSe2(pairs);
    case Alignment::kSe3:
      return FitSe3(pairs);
  }
  return Pose::Identity();
}

/// Angle of a rotation. Unlike the trace formula, it is exact near zero.
double Angle(const Pose& E) {
  const Quat q(E.linear());
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

PoseErrorSample Sample(TimeNs t_ns, const Pose& E) {
  return {t_ns, E.translation().norm(), Angle(E)};
}

std::vector<PoseErrorSample> Absolute(const std::vector<Pair>& pairs, const Pose& X_WV) {
  std::vector<PoseErrorSample> samples;
  for (const Pair& p : pairs) samples.push_back(Sample(p.t_ns, p.a.inverse() * X_WV * p.b));
  return samples;
}

Pose RelativeError(const Pair& from, const Pair& to) {
  return (from.a.inverse() * to.a).inverse() * (from.b.inverse() * to.b);
}

/// One sample for each pair that is followed by another pair after 1 to 1.5 times `interval_ns`.
std::vector<PoseErrorSample> Relative(const std::vector<Pair>& pairs, TimeNs interval_ns) {
  std::vector<PoseErrorSample> samples;
  std::size_t to = 0;
  for (const Pair& from : pairs) {
    while (to < pairs.size() && pairs[to].t_ns < from.t_ns + interval_ns) ++to;
    if (to == pairs.size()) break;
    if (pairs[to].t_ns <= from.t_ns + interval_ns + interval_ns / 2) {
      samples.push_back(Sample(from.t_ns, RelativeError(from, pairs[to])));
    }
  }
  return samples;
}

ErrorStatistics Statistics(std::vector<double> values) {
  ErrorStatistics s;
  if (values.empty()) return s;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) {
    s.mean += v / n;
    s.rmse += v * v / n;
  }
  s.rmse = std::sqrt(s.rmse);
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  s.median = values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  s.max = values.back();
  return s;
}

ErrorStatistics Statistics(const std::vector<PoseErrorSample>& samples,
                           double PoseErrorSample::*member) {
  std::vector<double> values;
  for (const PoseErrorSample& sample : samples) values.push_back(sample.*member);
  return Statistics(std::move(values));
}

double PathLength(const std::vector<Pair>& pairs, Pose Pair::*member) {
  double length_m = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    length_m += ((pairs[i].*member).translation() - (pairs[i - 1].*member).translation()).norm();
  }
  return length_m;
}

}  // namespace

std::optional<Pose> PoseAt(const Trajectory& track, TimeNs t_ns, TimeNs max_gap_ns) {
  const auto after = std::lower_bound(track.begin(), track.end(), t_ns,
                                      [](const TimedPose& p, TimeNs t) { return p.t_ns < t; });
  if (after == track.end()) return std::nullopt;
  if (after->t_ns == t_ns) return after->X_WB;
  if (after == track.begin()) return std::nullopt;
  const auto before = after - 1;
  const TimeNs gap_ns = after->t_ns - before->t_ns;
  if (gap_ns > max_gap_ns) return std::nullopt;
  const double s = static_cast<double>(t_ns - before->t_ns) / static_cast<double>(gap_ns);
  return Interpolate(before->X_WB, after->X_WB, s);
}

TrajectoryError EvaluateTrajectory(const Trajectory& a, const Trajectory& b,
                                   const TrajectoryErrorOptions& options) {
  const std::vector<Pair> pairs = Associate(a, b, options.max_gap_ns);
  if (pairs.size() < kMinPairs) {
    throw InputError(
        "", {FaultKind::kOutOfRange,
             fmt::format(
                 "the trajectories have {} times in common ({} and {} poses); need at least {}: "
                 "check that both recordings count time from the same start",
                 pairs.size(), a.size(), b.size(), kMinPairs)});
  }
  TrajectoryError error;
  error.X_WV = Align(pairs, options.alignment);
  error.ape = Absolute(pairs, error.X_WV);
  error.ape_translation_m = Statistics(error.ape, &PoseErrorSample::translation_m);
  error.ape_rotation_rad = Statistics(error.ape, &PoseErrorSample::rotation_rad);
  const auto rpe = Relative(pairs, options.relative_interval_ns);
  error.rpe_count = rpe.size();
  error.rpe_translation_m = Statistics(rpe, &PoseErrorSample::translation_m);
  error.rpe_rotation_rad = Statistics(rpe, &PoseErrorSample::rotation_rad);
  error.path_length_a_m = PathLength(pairs, &Pair::a);
  error.path_length_b_m = PathLength(pairs, &Pair::b);
  const PoseErrorSample drift = Sample(0, RelativeError(pairs.front(), pairs.back()));
  error.final_drift_m = drift.translation_m;
  error.final_drift_rad = drift.rotation_rad;
  return error;
}

}  // namespace tera
