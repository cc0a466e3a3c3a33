#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A valid scenario and the text that gives it again.
struct LoadedScenario {
  Scenario scenario;
  std::string resolved_yaml;
};

/// Reads a scenario with `key.path=value` overrides; below them, over the scenario's own, the
/// mapping `effects:` of each file of `effects`, the later above the earlier. Throws InputError
/// with every fault. Files that it names may have `moved`. What the scenario's `randomise:` draws
/// for an episode (randomise.h) lies below the overrides; the text has the values in place, and
/// what they were drawn for under `drawn:`.
LoadedScenario LoadScenario(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides,
                            const std::vector<std::string>& effects = {},
                            const std::vector<MovedFiles>& moved = {}, std::uint64_t episode = 0);

}  // namespace tera
