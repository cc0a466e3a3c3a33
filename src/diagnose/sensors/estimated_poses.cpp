#include "diagnose/sensors/estimated_poses.h"

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr TimeNs kEvery_ns = 100'000'000;

using Numbers = Eigen::Matrix<double, kBaseNumbers, 1>;

/// Half of the difference to the next part at a common border; 0 where a gap separates them.
Numbers HalfStep(const EstimatedMotion& part, const EstimatedMotion& next) {
  if (part.end_ns != next.start_ns) return Numbers::Zero();
  Numbers step = next.BaseNumbersAt(next.start_ns) - part.BaseNumbersAt(part.end_ns);
  step[kYaw] = std::remainder(step[kYaw], 2 * kPi);
  return step / 2;
}

}  // namespace

std::vector<TruthPose> EstimatedPoses(const SensorDiagnosis& estimate) {
  std::vector<TruthPose> poses;
  if (!estimate.knows_base) return poses;
  const std::vector<EstimatedMotion>& parts = estimate.motion;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const EstimatedMotion& part = parts[i];
    const Numbers at_start = i == 0 ? Numbers::Zero() : Numbers(-HalfStep(parts[i - 1], part));
    const Numbers at_end = i + 1 == parts.size() ? Numbers::Zero() : HalfStep(part, parts[i + 1]);
    const auto length_ns = static_cast<double>(part.end_ns - part.start_ns);
    const TimeNs first_ns = (part.start_ns + kEvery_ns - 1) / kEvery_ns * kEvery_ns;
    for (TimeNs t_ns = first_ns; t_ns <= part.end_ns; t_ns += kEvery_ns) {
      if (!poses.empty() && t_ns <= poses.back().t_ns) continue;
      const double s = static_cast<double>(t_ns - part.start_ns) / length_ns;
      const Numbers at = part.BaseNumbersAt(t_ns) + (1 - s) * at_start + s * at_end;
      poses.push_back(
          {.t_ns = t_ns, .X_WB = MakePose(at.head<3>(), at[kRoll], at[kRoll + 1], at[kYaw])});
    }
  }
  return poses;
}

}  // namespace tera
