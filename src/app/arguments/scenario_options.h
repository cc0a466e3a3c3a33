#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/rasterizer.h"
#include "sim/scenario/load_scenario.h"

namespace tera {

/// Scenario and its changes: the common options of all commands that take a scenario.
struct ScenarioOptions {
  std::string scenario;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set, effects;
  bool without_meshes = false;
  std::uint64_t episode = 0;  ///< episode of the `randomise:` draws
};

/// Resources of the host that a run may use.
struct HostOptions {
  HostOptions();

  int threads;  ///< default: all
  EglOptions egl;
};

/// Adds SCENARIO, --seed, --set, --effects, --without-meshes and --episode. The options must
/// outlive the parsing, here and below.
void AddScenarioOptions(CLI::App* command, ScenarioOptions* options);

/// Adds --threads and --egl-device.
void AddHostOptions(CLI::App* command, HostOptions* options);

/// Loads the scenario, with `overrides` above those of the options.
LoadedScenario Load(const ScenarioOptions& options, const std::vector<std::string>& overrides = {});

}  // namespace tera
