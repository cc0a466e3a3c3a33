#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A valid scenario and its complete text.
struct LoadedScenario {
  Scenario scenario;
  std::string resolved_yaml;
};

/// Reads a scenario. Layers, the highest first: `overrides` (key.path=value); the mapping
/// `effects:` of each file of `effects`, later files above earlier ones; the values that
/// `randomise:` draws for the episode (randomise.h); the scenario. The text contains the drawn
/// values, and lists them under `drawn:`. Files that the scenario names may have `moved`.
///
/// Throws  InputError with every fault.
LoadedScenario LoadScenario(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides,
                            const std::vector<std::string>& effects = {},
                            const std::vector<MovedFiles>& moved = {}, std::uint64_t episode = 0);

}  // namespace tera
