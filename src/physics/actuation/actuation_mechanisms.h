#pragma once

#include <span>

#include "core/types/effects.h"

namespace tera {

/// All mechanisms from the lever to the joint: timing, lever map, pump flow, actuator, kinematic
/// gain, load and friction. docs/reference/mechanisms.md gives equation and source of each.
std::span<const Mechanism> ActuationMechanisms();

}  // namespace tera
