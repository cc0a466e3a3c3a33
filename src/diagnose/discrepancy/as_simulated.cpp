#include "diagnose/discrepancy/as_simulated.h"

#include <algorithm>

#include "physics/actuation/axes.h"

namespace tera {

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
