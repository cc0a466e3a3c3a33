#include "diagnose/sensors/estimated_poses.h"

namespace tera {
namespace {

constexpr TimeNs kEvery_ns = 100'000'000;

}  // namespace

std::vector<TruthPose> EstimatedPoses(const SensorDiagnosis& estimate) {
  std::vector<TruthPose> poses;
  if (!estimate.knows_base) return poses;
  for (const EstimatedMotion& part : estimate.motion) {
    const TimeNs first_ns = (part.start_ns + kEvery_ns - 1) / kEvery_ns * kEvery_ns;
    for (TimeNs t_ns = first_ns; t_ns <= part.end_ns; t_ns += kEvery_ns) {
      if (!poses.empty() && t_ns <= poses.back().t_ns) continue;
      poses.push_back({.t_ns = t_ns, .X_WB = part.BaseAt(t_ns)});
    }
  }
  return poses;
}

}  // namespace tera
