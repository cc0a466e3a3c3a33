#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/arguments/scenario_options.h"
#include "diagnose/diagnose_recording.h"

namespace tera {

/// Inputs and output folder of a diagnosis.
struct DiagnoseArguments {
  ScenarioOptions scenario;
  std::vector<std::filesystem::path> recordings;  ///< at least one
  std::filesystem::path out;
  std::optional<std::filesystem::path> library;  ///< library of candidates
  DiagnosisTask task = {.threads = HostOptions().threads};
  bool profile = false;  ///< report the time of each stage
};

/// Writes the report of a diagnosis and prints its sentences, with progress on standard error.
/// Several recordings yield one report each and a joint report. Throws InputError.
void ReportDiagnosis(DiagnoseArguments arguments);

}  // namespace tera
