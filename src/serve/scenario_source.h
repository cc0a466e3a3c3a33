#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "sim/scenario/load_scenario.h"

namespace tera {

/// A scenario, with the resolved text that reproduces it.
struct SeededScenario {
  std::shared_ptr<const Scenario> scenario;
  std::string resolved_yaml;
};

/// Returns the scenario with the given seed, or with the seed in its file. Thread-safe.
using ScenarioSource = std::function<SeededScenario(std::optional<std::uint64_t> seed)>;

/// Creates a source for the scenario that `load` reads; `randomise` draws depend on the seed. YAML
/// files keep the content of their first read. Consecutive episodes with one seed share one
/// Scenario object. The scenario with its own seed is loaded at once; throws InputError if it is
/// faulty.
ScenarioSource SourceOf(std::function<LoadedScenario(std::optional<std::uint64_t>)> load);

}  // namespace tera
