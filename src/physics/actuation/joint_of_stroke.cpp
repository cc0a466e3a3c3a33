#include "physics/actuation/joint_of_stroke.h"

#include <algorithm>

#include "physics/actuation/linkage.h"

namespace tera {

double JointOfStroke(const MachineModel& model, const Cylinder& cylinder, double stroke_m) {
  const Joint& joint = model.joints[cylinder.joint];
  const double length_m = cylinder.shortest_m + stroke_m;
  double low_rad = joint.lower_rad, high_rad = joint.upper_rad;
  const CylinderReach at_low = ReachOf(model, cylinder, low_rad);
  const CylinderReach at_high = ReachOf(model, cylinder, high_rad);
  const double sign = at_high.length_m > at_low.length_m ? 1 : -1;
  if (sign * (length_m - at_low.length_m) <= 0) {
    return low_rad + (length_m - at_low.length_m) / at_low.arm_m;
  }
  if (sign * (length_m - at_high.length_m) >= 0) {
    return high_rad + (length_m - at_high.length_m) / at_high.arm_m;
  }
  constexpr int kHalvings = 60;  // to the resolution of a double
  for (int k = 0; k < kHalvings; ++k) {
    const double middle_rad = 0.5 * (low_rad + high_rad);
    const bool is_beyond = sign * (ReachOf(model, cylinder, middle_rad).length_m - length_m) > 0;
    (is_beyond ? high_rad : low_rad) = middle_rad;
  }
  return 0.5 * (low_rad + high_rad);
}

StrokeRange StrokesOf(const MachineModel& model, const Cylinder& cylinder) {
  const Joint& joint = model.joints[cylinder.joint];
  const double at_low_m = ReachOf(model, cylinder, joint.lower_rad).length_m;
  const double at_high_m = ReachOf(model, cylinder, joint.upper_rad).length_m;
  return {std::min(at_low_m, at_high_m) - cylinder.shortest_m,
          std::max(at_low_m, at_high_m) - cylinder.shortest_m};
}

}  // namespace tera
