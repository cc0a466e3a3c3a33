#pragma once

#include <vector>

#include "physics/actuation/actuation_faults.h"

namespace tera {

/// Effects of `base` that cannot act under any value of `ground`.
std::vector<EffectFault> FaultsOfBase(const MachineModel& model);

/// Faults of `base` with track kinematics: combined slips that cancel the speed of the tracks on
/// level ground.
std::vector<EffectFault> FaultsOfSlips(const MachineModel& model);

}  // namespace tera
