#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Value of an environment variable, or `usual`.
double FromEnvironment(const char* name, double usual);

/// Whether all values of a machine's state are finite.
bool IsFinite(const MachineState& state);

/// Angle between the undercarriage's z axis and the vertical.
double Tilt_rad(const MachineState& state);

}  // namespace tera
