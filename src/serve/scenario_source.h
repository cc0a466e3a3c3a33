#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "sim/scenario/load_scenario.h"

namespace tera {

/// A scenario and its reproducing text.
struct SeededScenario {
  std::shared_ptr<const Scenario> scenario;
  std::string resolved_yaml;
};

/// Returns the scenario with the given seed, or with its own seed. Any thread may call it.
using ScenarioSource = std::function<SeededScenario(std::optional<std::uint64_t> seed)>;

/// Source of the scenario that `load` reads, with what `randomise:` draws by the seed. YAML files
/// stay as they were when they were first read. Episodes in sequence with one seed share one
/// scenario. Throws InputError for faulty text, now for the scenario's own seed.
ScenarioSource SourceOf(std::function<LoadedScenario(std::optional<std::uint64_t>)> load);

}  // namespace tera
