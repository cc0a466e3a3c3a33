#pragma once

#include <span>
#include <string_view>

#include "core/types/effects.h"

namespace tera {

/// Mechanisms of the scene, by their measures: `terrain_height`, `object_added`, `object_missing`
/// and `dust`. A scenario has no such effects, so they have no target in effects.yaml.
std::span<const Mechanism> SceneMechanisms();

/// The mechanism with that identifier, which must exist.
const Mechanism& SceneMechanism(std::string_view id);

}  // namespace tera
