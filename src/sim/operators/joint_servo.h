#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Lever that drives joint `joint` from its present angle towards `target_rad`, which itself moves
/// at `target_rate_radps`: the rate that closes the error in 1 / `gain_1ps`, over the joint's own
/// rate at full lever in that direction, clamped to [-1, 1].
double ServoLever(const MachineModel& model, const MachineState& state, int joint,
                  double target_rad, double target_rate_radps, double gain_1ps);

/// Rate of joint `joint` over its own at full lever in that direction; 0 where it has none.
double ShareOfFullRate(const MachineModel& model, const MachineState& state, int joint);

}  // namespace tera
