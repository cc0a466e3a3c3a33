#include "sim/operators/joint_servo.h"

#include <algorithm>

namespace tera {

double ServoLever(const MachineModel& model, const MachineState& state, int joint,
                  double target_rad, double target_rate_radps, double gain_1ps) {
  const Joint& j = model.joints[joint];
  const double rate_radps = target_rate_radps + gain_1ps * (target_rad - state.q_rad[joint]);
  const double full_radps = rate_radps > 0 ? j.max_rate_positive_radps : j.max_rate_negative_radps;
  return full_radps > 0 ? std::clamp(rate_radps / full_radps, -1.0, 1.0) : 0.0;
}

double ShareOfFullRate(const MachineModel& model, const MachineState& state, int joint) {
  const Joint& j = model.joints[joint];
  const double rate_radps = state.qd_radps[joint];
  const double full_radps = rate_radps > 0 ? j.max_rate_positive_radps : j.max_rate_negative_radps;
  return full_radps > 0 ? rate_radps / full_radps : 0.0;
}

}  // namespace tera
