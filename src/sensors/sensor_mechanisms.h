#pragma once

#include <span>
#include <string_view>

#include "core/types/effects.h"

namespace tera {

/// All mechanisms that change a sensor's ideal measurement: geometry, static errors and timing.
/// docs/reference/mechanisms.md gives equation and source of each.
std::span<const Mechanism> SensorMechanisms();

/// The mechanism `id` that acts on `target`; it must exist. Several sensor kinds have a "bias" with
/// different parameters.
const Mechanism& SensorMechanism(std::string_view id, EffectTarget target);

}  // namespace tera
