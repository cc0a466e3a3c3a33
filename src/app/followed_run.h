#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/load_scenario.h"
#include "sim/generate.h"

namespace tera {

/// Options that every command has which writes a dataset: --out, --threads, --egl-device, --resume.
/// They go to `options`, which must outlive the parsing.
void AddRunOptions(CLI::App* command, GenerateOptions* options);

/// Generates `loaded` with its progress on the terminal, and what it cost after it.
void FollowRun(LoadedScenario loaded, GenerateOptions options);

}  // namespace tera
