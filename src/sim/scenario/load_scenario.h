#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A valid scenario and its YAML with all references and draws resolved.
struct LoadedScenario {
  Scenario scenario;
  std::string resolved_yaml;
};

/// Reads a scenario. Several layers set its values. From the highest to the lowest priority:
/// 1. `overrides` (key.path=value),
/// 2. the mapping `effects:` in each file of `effects`, later files first,
/// 3. the values that `randomise:` draws for the episode (randomise.h),
/// 4. the scenario file.
///
/// The resolved YAML contains the drawn values, and lists them under `drawn:`. `moved` gives new
/// places of files that the scenario names.
///
/// Throws  InputError with every fault.
LoadedScenario LoadScenario(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides,
                            const std::vector<std::string>& effects = {},
                            const std::vector<MovedFiles>& moved = {}, std::uint64_t episode = 0);

}  // namespace tera
