#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Number that an environment variable sets, else the usual one.
double FromEnvironment(const char* name, double usual);

/// Whether there is neither infinity nor NaN in anything that a machine's state tells.
bool IsFinite(const MachineState& state);

/// Angle between the undercarriage's z axis and the vertical.
double Tilt_rad(const MachineState& state);

}  // namespace tera
