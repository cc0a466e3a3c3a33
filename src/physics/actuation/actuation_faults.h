#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "physics/description/machine.h"

/// Effects that cannot act, because the machine lacks the necessary part or their numbers suppress
/// all motion.

namespace tera {

struct EffectFault {
  std::string_view mechanism;
  std::string finding;  ///< the fault and its remedy
};

/// Effects in `model.effects` that cannot act, for one target each.
std::vector<EffectFault> FaultsOfJoint(const MachineModel& model, std::size_t joint);
std::vector<EffectFault> FaultsOfGear(const MachineModel& model, std::size_t gear);
std::vector<EffectFault> FaultsOfPump(const MachineModel& model, std::size_t pump);

/// Reason why no drive turns a track or wheel set at a commanded rate; empty if one does.
std::string WhyGearUndriven(const MachineModel& model, std::size_t gear);

}  // namespace tera
