#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/rasterizer.h"
#include "sim/scenario/load_scenario.h"

namespace tera {

/// Common options of all commands that take a scenario: its file and changes to it.
struct ScenarioOptions {
  std::string scenario;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set, effects;
  bool without_meshes = false;
  std::uint64_t episode = 0;  ///< episode number for the draws of `randomise`
};

/// Resources of this computer that a run may use.
struct HostOptions {
  HostOptions();

  int threads;  ///< default: all cores
  EglOptions egl;
};

/// Adds SCENARIO, --seed, --set, --effects, --without-meshes and --episode. `options` must outlive
/// the parsing. The same applies to the other Add functions.
void AddScenarioOptions(CLI::App* command, ScenarioOptions* options);

void AddHostOptions(CLI::App* command, HostOptions* options);

/// Loads the scenario. `overrides` rank above those of the options.
LoadedScenario Load(const ScenarioOptions& options, const std::vector<std::string>& overrides = {});

}  // namespace tera
