#pragma once

#include <cstddef>
#include <string>

#include "physics/description/machine.h"

/// What levers drive, counted as the chain of actuation does: joints first, then running gears.

namespace tera {

std::string NameOfAxis(const MachineModel& model, std::size_t axis);

/// The axis of that name, -1 where the machine has none.
int AxisNamed(const MachineModel& model, const std::string& name);

/// Whether a lever of the machine drives the axis.
bool HasLever(const MachineModel& model, std::size_t axis);

}  // namespace tera
