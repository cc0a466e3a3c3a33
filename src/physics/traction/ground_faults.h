#pragma once

#include <vector>

#include "physics/actuation/actuation_faults.h"

namespace tera {

/// Those of the effects of `base` that cannot act, whatever `ground` moves the machine.
std::vector<EffectFault> FaultsOfBase(const MachineModel& model);

/// Faults in the effects of `base` on a machine that the kinematics of tracks move: slips that
/// together leave nothing of the tracks' speed on level ground.
std::vector<EffectFault> FaultsOfSlips(const MachineModel& model);

}  // namespace tera
