#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Lever that drives joint `joint` towards `target_rad`, which moves at `target_rate_radps`. The
/// rate closes the error in 1 / `gain_1ps`; the lever is this rate over the joint's rate at full
/// lever in that direction, clamped to [-1, 1].
double ServoLever(const MachineModel& model, const MachineState& state, int joint,
                  double target_rad, double target_rate_radps, double gain_1ps);

/// Rate of joint `joint` over its rate at full lever in that direction; 0 without such a rate.
double ShareOfFullRate(const MachineModel& model, const MachineState& state, int joint);

}  // namespace tera
