#pragma once

#include <span>

#include "core/types/effects.h"

namespace tera {

/// All mechanisms of running gear on the ground. docs/reference/mechanisms.md gives equation and
/// source of each.
std::span<const Mechanism> GroundMechanisms();

}  // namespace tera
