#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/arguments/scenario_options.h"
#include "diagnose/diagnose_recording.h"

namespace tera {

struct DiagnoseArguments {
  ScenarioOptions scenario;
  std::vector<std::filesystem::path> recordings;  ///< at least one
  std::filesystem::path out;
  std::optional<std::filesystem::path> library;  ///< library of candidate mechanisms
  DiagnosisTask task = {.threads = HostOptions().threads};
  bool profile = false;  ///< print the time of each stage
};

/// Runs a diagnosis, writes its report, and prints its conclusions; progress goes to standard
/// error. Several recordings give one report each and a joint report. Throws InputError.
void ReportDiagnosis(DiagnoseArguments arguments);

}  // namespace tera
