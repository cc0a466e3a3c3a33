#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Lever that drives a joint towards `target_rad`, which itself moves at `target_rate_radps`. The
/// joint rate is the target's rate plus `gain_1ps` times the error. The lever is that rate over the
/// joint's rate at full lever in that direction, clamped to [-1, 1].
double ServoLever(const MachineModel& model, const MachineState& state, int joint,
                  double target_rad, double target_rate_radps, double gain_1ps);

/// Current rate of a joint divided by its rate at full lever in that direction. 0 without such a
/// rate.
double ShareOfFullRate(const MachineModel& model, const MachineState& state, int joint);

}  // namespace tera
