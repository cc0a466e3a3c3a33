#pragma once

#include <span>
#include <string_view>

#include "core/types/effects.h"

namespace tera {

/// All mechanisms between a sensor's ideal measurement and its report: geometry, static errors and
/// timing. The list includes kind-specific and common mechanisms. docs/reference/mechanisms.md
/// gives equation and source of each.
std::span<const Mechanism> SensorMechanisms();

/// The existing mechanism `id` that acts on `target`. Several sensor kinds have a "bias" with
/// different parameters.
const Mechanism& SensorMechanism(std::string_view id, EffectTarget target);

}  // namespace tera
