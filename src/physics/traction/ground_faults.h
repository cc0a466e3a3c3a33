#pragma once

#include <vector>

#include "physics/actuation/actuation_faults.h"

namespace tera {

/// Those of the effects of `base` that cannot act, whatever `ground` moves the machine.
std::vector<EffectFault> FaultsOfBase(const MachineModel& model);

}  // namespace tera
