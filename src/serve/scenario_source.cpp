#include "serve/scenario_source.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "core/config/config.h"

namespace tera {
namespace {

SeededScenario ReadSeeded(const std::string& resolved_yaml, const std::string& name,
                          std::optional<std::uint64_t> seed) {
  std::vector<std::string> overrides;
  if (seed) overrides.push_back(fmt::format("seed={}", *seed));
  const Config config = Config::FromText(resolved_yaml, name, overrides);
  auto scenario = std::make_shared<const Scenario>(ReadScenario(config.root()));
  config.Finish();
  return {std::move(scenario), config.ResolvedYaml()};
}

}  // namespace

ScenarioSource SourceOf(const std::string& resolved_yaml, const std::string& name) {
  const SeededScenario own = ReadSeeded(resolved_yaml, name, std::nullopt);
  return [=](std::optional<std::uint64_t> seed) {
    if (!seed || *seed == own.scenario->seed) return own;
    return ReadSeeded(resolved_yaml, name, seed);
  };
}

}  // namespace tera
