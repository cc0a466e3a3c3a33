#pragma once

#include <vector>

#include "physics/actuation/actuation_faults.h"

namespace tera {

/// Of the effects of `base`, those that cannot act, whatever `ground` moves the machine.
std::vector<EffectFault> FaultsOfBase(const MachineModel& model);

}  // namespace tera
