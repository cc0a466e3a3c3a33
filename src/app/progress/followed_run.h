#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "app/arguments/scenario_options.h"
#include "sim/scenario/load_scenario.h"

namespace tera {

/// What every command is told that writes a dataset from its beginning to its end.
struct RunOptions {
  std::filesystem::path out;
  bool resume = false;
  HostOptions host;
};

/// --out, --resume, and those of the host. The options must outlive the parsing.
void AddRunOptions(CLI::App* command, RunOptions* options);

/// Generates `loaded`, its progress on standard error where that is a terminal, and prints at its
/// end what it cost.
void FollowRun(const LoadedScenario& loaded, const RunOptions& options);

}  // namespace tera
