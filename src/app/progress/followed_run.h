#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

#include "app/arguments/scenario_options.h"
#include "sim/run/generate.h"
#include "sim/scenario/load_scenario.h"

namespace tera {

/// Common options of all commands that write a dataset.
struct RunOptions {
  std::filesystem::path out;
  bool resume = false, keep_state = false;
  HostOptions host;
};

/// Adds --out, --resume and the host options. `options` must outlive the parsing.
void AddRunOptions(CLI::App* command, RunOptions* options);

using DatasetRun = std::function<GenerateReport(const GenerateOptions&)>;

/// Executes a run. Shows its progress on standard error and prints its timing at the end.
void FollowRun(const DatasetRun& run, const RunOptions& options);
/// Simulates a scenario with progress and timing.
void FollowRun(const LoadedScenario& loaded, const RunOptions& options);

}  // namespace tera
