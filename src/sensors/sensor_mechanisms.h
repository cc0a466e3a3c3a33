#pragma once

#include <span>
#include <string_view>

#include "core/types/effects.h"

namespace tera {

/// All mechanisms between a sensor's ideal measurement and what it reports: geometry, static
/// errors, timing; of each kind its own, and those that several kinds share.
/// docs/reference/mechanisms.md has the equation and the source of each.
std::span<const Mechanism> SensorMechanisms();

/// The mechanism of that id that acts on `target`, which must be there: several kinds of sensors
/// have a "bias", each with numbers of its own.
const Mechanism& SensorMechanism(std::string_view id, EffectTarget target);

}  // namespace tera
