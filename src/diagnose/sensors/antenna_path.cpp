#include "diagnose/sensors/antenna_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/motion/starting_motion.h"
#include "diagnose/sensors/gear_travel.h"

namespace tera {
namespace {

constexpr double kStep_s = 0.05;  ///< time step of the path

/// The time that all series cover.
struct Span {
  double from_s = std::numeric_limits<double>::lowest();
  double to_s = std::numeric_limits<double>::max();
  void Narrow(double first_s, double last_s) {
    from_s = std::max(from_s, first_s);
    to_s = std::min(to_s, last_s);
  }
};

/// Readings of a joint by its first encoder.
TimeSeries ReadingsOf(const Measurements& measured, const std::string& joint, TimeNs zero_ns) {
  TimeSeries readings;
  for (const NamedEncoders& named : measured.encoders) {
    for (std::size_t axis = 0; axis < named.recording.axes.size(); ++axis) {
      if (named.recording.axes[axis].name != joint || !readings.empty()) continue;
      for (const EncoderSample& sample : named.recording.samples) {
        readings.t_s.push_back(ToSeconds(sample.t_ns - zero_ns));
        readings.value.push_back(sample.q_rad[axis]);
      }
    }
  }
  return readings;
}

/// Adds the joints before a link. False where a joint with a lever has no encoder.
bool AddJoints(const MachineModel& model, const Measurements& measured, int link, TimeNs zero_ns,
               RoughSources* sources, std::vector<int>* places, Span* span) {
  places->assign(model.joints.size(), -1);
  while (link > 0) {
    const auto j = static_cast<std::size_t>(link) - 1;
    const Joint& joint = model.joints[j];
    link = joint.parent;
    if (joint.type == JointType::kFixed) continue;
    TimeSeries readings = ReadingsOf(measured, joint.name, zero_ns);
    if (readings.empty()) {
      const auto drives = [&](const Lever& lever) { return lever.joint == static_cast<int>(j); };
      if (std::any_of(model.levers.begin(), model.levers.end(), drives)) return false;
      continue;
    }
    span->Narrow(readings.t_s.front(), readings.t_s.back());
    (*places)[j] = static_cast<int>(sources->joints.size());
    sources->joints.push_back(std::move(readings));
  }
  return true;
}

/// Adds the sources of the base's motion. False where there are none.
bool AddBase(const DiagnosisInput& input, const Measurements& measured, TimeNs zero_ns,
             RoughSources* sources, Span* span) {
  sources->travel = GearTravel(input, measured, zero_ns);
  if (!sources->travel.empty()) {
    span->Narrow(sources->travel.front().from_s, sources->travel.back().to_s);
    return true;
  }
  if (input.model->fixed_base) return true;
  for (const TruthPose& pose : measured.poses) {
    sources->poses_t_s.push_back(ToSeconds(pose.t_ns - zero_ns));
    sources->poses.push_back(pose.X_WB);
  }
  if (sources->poses.empty()) return false;
  span->Narrow(sources->poses_t_s.front(), sources->poses_t_s.back());
  return true;
}

}  // namespace

std::optional<PlanarPath> AntennaPath(const DiagnosisInput& input, const Measurements& measured,
                                      const SensorDescription& receiver, TimeNs zero_ns) {
  const int link = input.model->LinkIndex(receiver.link);
  RoughSources sources;
  std::vector<int> places;
  Span span;
  if (link < 0 || !AddJoints(*input.model, measured, link, zero_ns, &sources, &places, &span) ||
      !AddBase(input, measured, zero_ns, &sources, &span)) {
    return std::nullopt;
  }
  const auto chain = ChainTo(*input.model, link, places);
  const bool is_bounded = span.from_s > std::numeric_limits<double>::lowest();
  if (!chain || !is_bounded || span.to_s <= span.from_s) return std::nullopt;
  const AntennaTrack antenna{*chain, receiver.X_BS.translation(), {}, {}};
  const auto base = RoughBase(sources);
  PlanarPath path{span.from_s, kStep_s, {}};
  for (int k = 0; span.from_s + k * kStep_s <= span.to_s; ++k) {
    const double t_s = span.from_s + k * kStep_s;
    const Vec3 rpy_rad(base[kRoll].At(t_s), base[kRoll + 1].At(t_s), base[kYaw].At(t_s));
    const Vec3 away_m = RotationFromRpy(rpy_rad.x(), rpy_rad.y(), rpy_rad.z()) *
                        AntennaInBase(antenna, sources.joints, t_s);
    path.at_m.emplace_back(base[0].At(t_s) + away_m.x(), base[1].At(t_s) + away_m.y());
  }
  return path;
}

}  // namespace tera
