#pragma once

#include <filesystem>
#include <optional>

#include "app/arguments/scenario_options.h"
#include "diagnose/diagnose_recording.h"

namespace tera {

/// What is to be diagnosed by what, and where the report goes.
struct DiagnoseArguments {
  ScenarioOptions scenario;
  std::filesystem::path recording, out;
  std::optional<std::filesystem::path> library;  ///< of candidates
  DiagnosisTask task = {.threads = HostOptions().threads};
  bool profile = false;  ///< tell where the time went
};

/// Writes the report of a diagnosis and prints its sentences, its progress on standard error.
/// Throws InputError.
void ReportDiagnosis(DiagnoseArguments arguments);

}  // namespace tera
