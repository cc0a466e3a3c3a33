#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

#include "app/arguments/scenario_options.h"
#include "sim/run/generate.h"
#include "sim/scenario/load_scenario.h"

namespace tera {

/// Options of every command that writes a whole dataset.
struct RunOptions {
  std::filesystem::path out;
  bool resume = false, keep_state = false;
  HostOptions host;
};

/// Adds --out, --resume and the host options. The options must outlive the parsing.
void AddRunOptions(CLI::App* command, RunOptions* options);

/// A run that writes a dataset according to the options.
using DatasetRun = std::function<GenerateReport(const GenerateOptions&)>;

/// Executes a run, with progress on a terminal's standard error, and prints its cost at the end.
void FollowRun(const DatasetRun& run, const RunOptions& options);
/// Simulates a scenario in the same way.
void FollowRun(const LoadedScenario& loaded, const RunOptions& options);

}  // namespace tera
