#include "diagnose/replay/link_track.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnose/statistics/series/robust.h"
#include "physics/actuation/axes.h"

namespace tera {
namespace {

constexpr double kLeastTurning_radps = 1e-3;  ///< running gear that turns more slowly is at rest
/// Motion is known between measurements that are at most this far apart.
constexpr TimeNs kNear_ns = 300'000'000;

/// Whether a measurement is near enough to a time.
bool KnownAt(const std::vector<TimeNs>& t_ns, TimeNs at_ns) {
  const auto next = std::lower_bound(t_ns.begin(), t_ns.end(), at_ns);
  if (next == t_ns.end()) return false;
  if (*next == at_ns) return true;
  return next != t_ns.begin() && *next - *(next - 1) <= kNear_ns;
}

/// Samples of a joint, with positions derived from its leading joint if it follows one.
std::optional<AxisSamples> SamplesOf(const MachineModel& model, const Joint& joint,
                                     const std::vector<NamedEncoders>& encoders) {
  std::optional<AxisSamples> own = SamplesOf(joint.name, encoders);
  if (own || !joint.following) return own;
  std::optional<AxisSamples> led = SamplesOf(model.joints[joint.following->leader].name, encoders);
  if (!led) return led;
  for (double& position : led->position_rad) position = joint.following->At(position);
  return led;
}

/// Joints between the base and a link.
std::vector<std::size_t> WayTo(const MachineModel& model, int link) {
  std::vector<std::size_t> way;
  for (std::size_t j = model.joints.size(); j-- > 0;) {
    if (model.joints[j].child != link) continue;
    way.push_back(j);
    link = model.joints[j].parent;
  }
  return way;
}

/// Positions of the joints between base and link, by joint; none if a moving joint has no encoder.
std::optional<std::vector<std::optional<AxisSamples>>> JointsTo(
    const MachineModel& model, const std::vector<NamedEncoders>& encoders, int link) {
  std::vector<std::optional<AxisSamples>> joints(model.joints.size());
  for (const std::size_t j : WayTo(model, link)) {
    if (model.joints[j].type == JointType::kFixed) continue;
    joints[j] = SamplesOf(model, model.joints[j], encoders);
    if (!joints[j] && HasLever(model, LeaderOf(model, static_cast<int>(j)))) return std::nullopt;
  }
  return joints;
}

/// True if all tracks and wheels were measured and none turned.
bool StoodStill(const MachineModel& model, const std::vector<NamedEncoders>& encoders) {
  if (model.fixed_base) return true;
  const auto& gears = model.ground_tools.gears;
  return !gears.empty() && std::all_of(gears.begin(), gears.end(), [&](const RunningGear& gear) {
    const auto samples = SamplesOf(gear.name, encoders);
    return samples && LargestMagnitude(samples->rate_radps) <= kLeastTurning_radps;
  });
}

}  // namespace

Pose LinkTrack::At(TimeNs at_ns) const {
  if (at_ns <= start_ns) return X_WL.front();
  const auto k = static_cast<std::size_t>((at_ns - start_ns) / step_ns);
  if (k + 1 >= X_WL.size()) return X_WL.back();
  const double s = static_cast<double>(at_ns - t_ns(k)) / static_cast<double>(step_ns);
  return Interpolate(X_WL[k], X_WL[k + 1], s);
}

Vec3 LinkTrack::PointAt(TimeNs at_ns, const Vec3& p_L_m) const {
  if (at_ns <= start_ns) return X_WL.front() * p_L_m;
  const auto k = static_cast<std::size_t>((at_ns - start_ns) / step_ns);
  if (k + 1 >= X_WL.size()) return X_WL.back() * p_L_m;
  const double s = static_cast<double>(at_ns - t_ns(k)) / static_cast<double>(step_ns);
  return (1 - s) * (X_WL[k] * p_L_m) + s * (X_WL[k + 1] * p_L_m);
}

LinkTrack TrackOfLink(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                      const std::vector<TruthPose>& poses, int link, TimeNs from_ns, TimeNs to_ns,
                      TimeNs step_ns) {
  LinkTrack track{from_ns, step_ns, {}, {}};
  const auto joints = JointsTo(model, encoders, link);
  if (!joints || (poses.empty() && !StoodStill(model, encoders))) return track;
  std::vector<TimeNs> base_ns;
  for (const TruthPose& pose : poses) base_ns.push_back(pose.t_ns);
  std::vector<double> q_rad(model.joints.size());
  for (TimeNs t = from_ns; t <= to_ns; t += step_ns) {
    bool known = poses.empty() || KnownAt(base_ns, t);
    Pose X_WB = Pose::Identity();
    if (!poses.empty()) {
      const BetweenSamples at(base_ns, t);
      X_WB = Interpolate(poses[at.a].X_WB, poses[at.b].X_WB, at.s);
    }
    for (std::size_t j = 0; j < q_rad.size(); ++j) {
      q_rad[j] = model.joints[j].initial_rad;
      if (const auto& joint = (*joints)[j]) {
        q_rad[j] = BetweenSamples(joint->t_ns, t).Of(joint->position_rad);
        known = known && KnownAt(joint->t_ns, t);
      }
    }
    track.X_WL.push_back(ForwardKinematics(model, X_WB, q_rad)[static_cast<std::size_t>(link)]);
    track.known.push_back(known);
  }
  return track;
}

}  // namespace tera
