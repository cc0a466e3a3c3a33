#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/scenario_options.h"

namespace tera {

/// What is to be diagnosed by what, and where the report goes.
struct DiagnoseArguments {
  ScenarioOptions scenario;
  std::filesystem::path recording, out;
  std::vector<std::filesystem::path> held_out;   ///< further recordings, to be judged by
  std::optional<std::filesystem::path> library;  ///< of candidates
  std::optional<double> from_s, to_s, time_limit_s;
  bool simulate = true;  ///< the whole scenario, to confirm what was found
  int threads = HostOptions().threads;
  bool profile = false;  ///< tell where the time went
};

/// A folder that is not there yet, so that nothing of an earlier run is mixed in.
void RequireNewFolder(const std::filesystem::path& out);

/// What four simpler methods make of it, as baselines.json has it
/// (diagnose/search/structure/baselines.h), of the scenario's first machine. Throws InputError.
std::string BaselinesOfRecording(const DiagnoseArguments& arguments);

/// `tera diagnose`: writes the report and prints its sentences. Throws InputError.
void DiagnoseRecording(const DiagnoseArguments& arguments);

}  // namespace tera
