#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "sim/scenario/scenario.h"

namespace tera {

/// A scenario and its reproducing text.
struct SeededScenario {
  std::shared_ptr<const Scenario> scenario;
  std::string resolved_yaml;
};

/// Returns the scenario with the given seed, or with its own seed.
using ScenarioSource = std::function<SeededScenario(std::optional<std::uint64_t> seed)>;

/// Source of the scenario in the text `resolved_yaml`, independent of later changes to its file.
/// Messages call it `name`. Episodes with its own seed share one scenario. Another seed creates
/// another scenario from the text, because its terrain may differ. Throws InputError for faulty
/// text.
ScenarioSource SourceOf(const std::string& resolved_yaml, const std::string& name);

}  // namespace tera
