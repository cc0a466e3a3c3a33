#include "diagnose/sensors/late_poses.h"

#include "diagnose/blocks/measured_poses.h"

namespace tera {

bool StampPosesAnew(const SensorDiagnosis& estimate, Measurements* measured) {
  bool has_changed = false;
  for (const SensorFinding& found : estimate.findings) {
    const bool is_clock = found.target == kPoses && found.mechanism->id == "clock_offset";
    if (!is_clock || !found.rivals.empty()) continue;
    for (TruthPose& pose : measured->poses) {
      pose.t_ns -= FromSeconds(found.numbers.front().value);
      has_changed = true;
    }
  }
  return has_changed;
}

}  // namespace tera
