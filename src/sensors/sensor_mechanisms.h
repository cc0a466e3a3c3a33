#pragma once

#include <span>

#include "core/types/effects.h"

namespace tera {

/// All mechanisms between a sensor's ideal measurement and what it reports: geometry, static
/// errors, timing; of each kind its own, and those that several kinds share.
/// docs/reference/mechanisms.md has the equation and the source of each.
std::span<const Mechanism> SensorMechanisms();

}  // namespace tera
