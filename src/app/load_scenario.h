#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/config.h"
#include "sim/scenario.h"

namespace tera {

/// A valid scenario and the text that gives it again.
struct LoadedScenario {
  Scenario scenario;
  std::string resolved_yaml;
};

/// Reads a scenario with `key.path=value` overrides. Throws InputError with every fault.
inline LoadedScenario LoadScenario(const std::filesystem::path& file,
                                   const std::vector<std::string>& overrides) {
  const Config config = Config::FromFile(file, overrides);
  LoadedScenario loaded;
  loaded.scenario = ReadScenario(config.root());
  config.Finish();
  loaded.resolved_yaml = config.ResolvedYaml();
  return loaded;
}

}  // namespace tera
