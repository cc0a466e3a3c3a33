#pragma once

#include <cstddef>
#include <string>

#include "physics/description/machine.h"

/// Names of the axes that levers drive, in the order of the actuation chain: joints first, then
/// running gears.

namespace tera {

std::string NameOfAxis(const MachineModel& model, std::size_t axis);

/// Index of the axis of that name, or -1.
int AxisNamed(const MachineModel& model, const std::string& name);

/// True if a lever of the machine drives the axis.
bool HasLever(const MachineModel& model, std::size_t axis);

}  // namespace tera
