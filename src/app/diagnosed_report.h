#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/arguments/scenario_options.h"
#include "diagnose/diagnose_recording.h"

namespace tera {

/// What is to be diagnosed by what, and where the report goes.
struct DiagnoseArguments {
  ScenarioOptions scenario;
  std::vector<std::filesystem::path> recordings;  ///< at least one
  std::filesystem::path out;
  std::optional<std::filesystem::path> library;  ///< of candidates
  DiagnosisTask task = {.threads = HostOptions().threads};
  bool profile = false;  ///< tell where the time went
};

/// Writes the report of a diagnosis, or of one of each recording and of what they say together, and
/// prints its sentences, its progress on standard error. Throws InputError.
void ReportDiagnosis(DiagnoseArguments arguments);

}  // namespace tera
