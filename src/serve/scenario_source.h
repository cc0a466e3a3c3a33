#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "sim/scenario/scenario.h"

namespace tera {

/// A scenario and the text that gives it again.
struct SeededScenario {
  std::shared_ptr<const Scenario> scenario;
  std::string resolved_yaml;
};

/// The scenario with that seed or, without one, its own.
using ScenarioSource = std::function<SeededScenario(std::optional<std::uint64_t> seed)>;

/// The source of a scenario as its text `resolved_yaml` has it now, whatever becomes of its file;
/// messages call it `name`. Episodes of its own seed share one scenario. Another seed makes another
/// one, which is read from the text: its ground may have another relief. Throws InputError where
/// the text is at fault.
ScenarioSource SourceOf(const std::string& resolved_yaml, const std::string& name);

}  // namespace tera
