#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/rasterizer.h"
#include "sim/scenario/load_scenario.h"

namespace tera {

/// Which scenario, and what is changed in it: the same words for every command that takes one.
struct ScenarioOptions {
  std::string scenario;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set, effects;
  bool without_meshes = false;
  std::uint64_t episode = 0;  ///< of what `randomise:` draws
};

/// What of this machine a run may use.
struct HostOptions {
  HostOptions();

  int threads;  ///< all, unless given
  EglOptions egl;
};

/// SCENARIO, --seed, --set, --effects, --without-meshes, --episode. The options must outlive the
/// parsing; so below.
void AddScenarioOptions(CLI::App* command, ScenarioOptions* options);

/// --threads, --egl-device.
void AddHostOptions(CLI::App* command, HostOptions* options);

/// The scenario, with `overrides` above those of the options.
LoadedScenario Load(const ScenarioOptions& options, const std::vector<std::string>& overrides = {});

}  // namespace tera
