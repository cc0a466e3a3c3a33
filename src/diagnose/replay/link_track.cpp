#include "diagnose/replay/link_track.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnose/replay/between_samples.h"
#include "physics/actuation/axes.h"

namespace tera {
namespace {

constexpr double kLeastTurning_radps = 1e-3;  ///< running gear that turns more slowly is at rest
/// Motion is known between measurements that are at most this far apart.
constexpr TimeNs kNear_ns = 300'000'000;

/// Measured positions of one joint, or poses of the base.
template <typename Value>
struct Measured {
  std::vector<TimeNs> t_ns;
  std::vector<Value> value;

  bool KnownAt(TimeNs t) const {
    const auto next = std::lower_bound(t_ns.begin(), t_ns.end(), t);
    if (next == t_ns.end()) return false;
    if (*next == t) return true;
    return next != t_ns.begin() && *next - *(next - 1) <= kNear_ns;
  }
};

std::optional<Measured<double>> PositionOf(const std::string& joint,
                                           const std::vector<NamedEncoders>& encoders) {
  for (const auto& [channel, recording] : encoders) {
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
      if (recording.axes[i].name != joint || recording.samples.empty()) continue;
      Measured<double> measured;
      for (const EncoderSample& sample : recording.samples) {
        measured.t_ns.push_back(sample.t_ns);
        measured.value.push_back(sample.q_rad[i]);
      }
      return measured;
    }
  }
  return std::nullopt;
}

/// Position of a joint. A joint without an encoder that follows another joint gets its position
/// from it.
std::optional<Measured<double>> PositionOf(const MachineModel& model, const Joint& joint,
                                           const std::vector<NamedEncoders>& encoders) {
  std::optional<Measured<double>> own = PositionOf(joint.name, encoders);
  if (own || !joint.following) return own;
  std::optional<Measured<double>> led =
      PositionOf(model.joints[joint.following->leader].name, encoders);
  if (!led) return led;
  for (double& position : led->value) position = joint.following->At(position);
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

/// Positions of the joints between base and link, by joint. Returns nothing if a driven joint has
/// no encoder.
std::optional<std::vector<std::optional<Measured<double>>>> JointsTo(
    const MachineModel& model, const std::vector<NamedEncoders>& encoders, int link) {
  std::vector<std::optional<Measured<double>>> joints(model.joints.size());
  for (const std::size_t j : WayTo(model, link)) {
    if (model.joints[j].type == JointType::kFixed) continue;
    joints[j] = PositionOf(model, model.joints[j], encoders);
    if (!joints[j] && HasLever(model, LeaderOf(model, static_cast<int>(j)))) return std::nullopt;
  }
  return joints;
}

/// True if all tracks and wheels were measured and none turned.
bool StoodStill(const MachineModel& model, const std::vector<NamedEncoders>& encoders) {
  if (model.fixed_base) return true;
  std::size_t measured = 0;
  for (const auto& [channel, recording] : encoders) {
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
      const auto& gears = model.ground_tools.gears;
      const bool is_gear = std::any_of(gears.begin(), gears.end(), [&](const RunningGear& gear) {
        return gear.name == recording.axes[i].name;
      });
      if (!is_gear) continue;
      ++measured;
      for (const EncoderSample& sample : recording.samples) {
        if (std::abs(sample.qd_radps[i]) > kLeastTurning_radps) return false;
      }
    }
  }
  return measured > 0 && measured == model.ground_tools.gears.size();
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
  Measured<Pose> base;
  for (const TruthPose& pose : poses) {
    base.t_ns.push_back(pose.t_ns);
    base.value.push_back(pose.X_WB);
  }
  std::vector<double> q_rad(model.joints.size());
  for (TimeNs t = from_ns; t <= to_ns; t += step_ns) {
    bool known = base.t_ns.empty() || base.KnownAt(t);
    Pose X_WB = Pose::Identity();
    if (!base.t_ns.empty()) {
      const BetweenSamples at(base.t_ns, t);
      X_WB = Interpolate(base.value[at.a], base.value[at.b], at.s);
    }
    for (std::size_t j = 0; j < q_rad.size(); ++j) {
      q_rad[j] = model.joints[j].initial_rad;
      if (const auto& joint = (*joints)[j]) {
        q_rad[j] = BetweenSamples(joint->t_ns, t).Of(joint->value);
        known = known && joint->KnownAt(t);
      }
    }
    track.X_WL.push_back(ForwardKinematics(model, X_WB, q_rad)[static_cast<std::size_t>(link)]);
    track.known.push_back(known);
  }
  return track;
}

}  // namespace tera
