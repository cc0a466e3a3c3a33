#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

#include "app/arguments/scenario_options.h"
#include "sim/run/generate.h"
#include "sim/scenario/load_scenario.h"

namespace tera {

/// What every command is told that writes a dataset from its beginning to its end.
struct RunOptions {
  std::filesystem::path out;
  bool resume = false, keep_state = false;
  HostOptions host;
};

/// --out, --resume, and those of the host. The options must outlive the parsing.
void AddRunOptions(CLI::App* command, RunOptions* options);

/// A run that writes a dataset as these options say.
using DatasetRun = std::function<GenerateReport(const GenerateOptions&)>;

/// Follows a run, its progress on standard error where that is a terminal, and prints at its end
/// what it cost.
void FollowRun(const DatasetRun& run, const RunOptions& options);
/// The same of a scenario that is simulated.
void FollowRun(const LoadedScenario& loaded, const RunOptions& options);

}  // namespace tera
