#pragma once

#include <span>

#include "core/types/effects.h"

namespace tera {

/// All mechanisms of running gear on the ground. docs/reference/mechanisms.md has each mechanism's
/// equation and source.
std::span<const Mechanism> GroundMechanisms();

}  // namespace tera
