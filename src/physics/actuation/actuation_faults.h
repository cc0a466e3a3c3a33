#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "physics/description/machine.h"

/// Effects that cannot act: on a machine that lacks what they act through, so that they change
/// nothing, or with numbers that leave no lever anything to move.

namespace tera {

/// An effect that cannot act, and what is in its way.
struct EffectFault {
  std::string_view mechanism;
  std::string finding;  ///< what was found and what is needed
};

/// Those of the effects in `model.effects` that cannot act, for one target each.
std::vector<EffectFault> FaultsOfJoint(const MachineModel& model, std::size_t joint);
std::vector<EffectFault> FaultsOfGear(const MachineModel& model, std::size_t gear);
std::vector<EffectFault> FaultsOfPump(const MachineModel& model, std::size_t pump);

/// Why nothing turns a track or wheel set at a commanded rate, empty if something does.
std::string WhyGearUndriven(const MachineModel& model, std::size_t gear);

}  // namespace tera
