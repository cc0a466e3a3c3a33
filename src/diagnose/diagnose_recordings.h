#pragma once

#include <filesystem>
#include <vector>

#include "diagnose/diagnose_recording.h"

namespace tera {

/// One of several recordings, with the diagnosis of each machine of the scenario.
struct DiagnosedRecording {
  std::filesystem::path directory;
  std::vector<Diagnosis> machines;
};

/// Diagnoses several recordings of a scenario's machines, one after the other. Each is diagnosed by
/// itself, and its findings are tested on all others. Before any search, throws InputError for an
/// unreadable recording, a repeated name or overlapping epochs.
std::vector<DiagnosedRecording> DiagnoseRecordings(
    const Scenario& scenario, const std::vector<std::filesystem::path>& recordings,
    const DiagnosisTask& task, const FollowProgress& progress, StageClock* clock);

/// The diagnoses of one machine, in the order of the recordings.
std::vector<const Diagnosis*> OfMachine(const std::vector<DiagnosedRecording>& recordings,
                                        std::size_t machine);

}  // namespace tera
