#include "diagnose/discrepancy/simulated_course.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// A time as a step and the share of the way to the next one.
struct Place {
  std::size_t a = 0, b = 0;
  double s = 0;
};

Place PlaceOf(const SimulatedCourse& course, TimeNs t_ns) {
  const auto last = static_cast<double>(course.steps.size() - 1);
  const double at = std::clamp(ToSeconds(t_ns - course.zero_ns) / course.step_s, 0.0, last);
  const auto a = static_cast<std::size_t>(at);
  return {a, std::min(a + 1, course.steps.size() - 1), at - static_cast<double>(a)};
}

int AxisNamed(const MachineModel& model, const std::string& name) {
  if (const int joint = model.JointIndex(name); joint >= 0) return joint;
  const auto& gears = model.ground_tools.gears;
  const auto gear = std::find_if(gears.begin(), gears.end(),
                                 [&](const RunningGear& one) { return one.name == name; });
  if (gear == gears.end()) return -1;
  return static_cast<int>(model.joints.size()) + static_cast<int>(gear - gears.begin());
}

}  // namespace

double SimulatedCourse::RateAt(TimeNs t_ns, std::size_t axis) const {
  const auto [a, b, s] = PlaceOf(*this, t_ns);
  return std::lerp(steps[a].rate_radps[axis], steps[b].rate_radps[axis], s);
}

double SimulatedCourse::PositionAt(TimeNs t_ns, std::size_t axis) const {
  const auto [a, b, s] = PlaceOf(*this, t_ns);
  return std::lerp(steps[a].position_rad[axis], steps[b].position_rad[axis], s);
}

Pose SimulatedCourse::PoseAt(TimeNs t_ns) const {
  const auto [a, b, s] = PlaceOf(*this, t_ns);
  return Interpolate(steps[a].X_WB, steps[b].X_WB, s);
}

std::vector<NamedEncoders> AsSimulated(const MachineModel& model, const SimulatedCourse& course,
                                       std::vector<NamedEncoders> measured) {
  for (NamedEncoders& named : measured) {
    EncoderRecording& recording = named.recording;
    std::erase_if(recording.samples,
                  [&](const EncoderSample& sample) { return sample.t_ns > course.end_ns(); });
    for (std::size_t i = 0; i < recording.axes.size(); ++i) {
      const int axis = AxisNamed(model, recording.axes[i].name);
      if (axis < 0) continue;
      for (EncoderSample& sample : recording.samples) {
        sample.q_rad[i] = course.PositionAt(sample.t_ns, static_cast<std::size_t>(axis));
        sample.qd_radps[i] = course.RateAt(sample.t_ns, static_cast<std::size_t>(axis));
      }
    }
  }
  return measured;
}

std::vector<TruthPose> AsSimulated(const SimulatedCourse& course,
                                   const std::vector<TruthPose>& measured) {
  std::vector<TruthPose> poses;
  for (const TruthPose& one : measured) {
    if (one.t_ns < course.zero_ns || one.t_ns > course.end_ns()) continue;
    TruthPose pose;
    pose.t_ns = one.t_ns;
    pose.X_WB = course.PoseAt(one.t_ns);
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace tera
