#pragma once

#include <span>
#include <string_view>

#include "core/types/effects.h"

namespace tera {

/// What may differ in the scene, by its measures: `terrain_height`, `object_added`,
/// `object_missing` and `dust`. A scenario has no such effects, so that they act on no target of
/// effects.yaml.
std::span<const Mechanism> SceneMechanisms();

/// The one of them by that identifier, which must be there.
const Mechanism& SceneMechanism(std::string_view id);

}  // namespace tera
