#pragma once

#include <filesystem>
#include <optional>

#include "app/scenario_options.h"

namespace tera {

/// What is to be diagnosed by what, and where the report goes.
struct DiagnoseArguments {
  ScenarioOptions scenario;
  std::filesystem::path recording, out;
  std::optional<double> from_s, to_s;
  int threads = HostOptions().threads;
};

/// A folder that is not there yet, so that nothing of an earlier run is mixed in.
void RequireNewFolder(const std::filesystem::path& out);

/// `tera diagnose`: writes the report and prints its sentences. Throws InputError.
void DiagnoseRecording(const DiagnoseArguments& arguments);

}  // namespace tera
