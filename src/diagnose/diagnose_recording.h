#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/stage_clock.h"
#include "dataset/format/recording.h"
#include "diagnose/diagnose_machine.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Part of a recording to diagnose, and options.
struct DiagnosisTask {
  std::vector<std::filesystem::path> held_out;  ///< further recordings, for validation
  std::optional<CandidateLibrary> library;      ///< restricts or extends the blocks' candidates
  std::optional<double> from_s, to_s, time_limit_s;
  bool simulate = true;  ///< true if the whole scenario is simulated too
  int threads = 1;
};

/// Throws InputError if the times of two recordings overlap by their epochs. The validation would
/// then use data of the fit. Without epochs, an overlap cannot be detected.
void RequireOtherTime(const Recording& one, const Recording& other);

/// Diagnoses the differences between a recording and a scenario. Returns one diagnosis per machine,
/// with its joints, tracks, base and sensors. `progress` is called for each block; `clock` times
/// the stages. Throws InputError if the recording cannot be compared.
std::vector<Diagnosis> DiagnoseRecording(const Scenario& scenario, const Recording& recording,
                                         const DiagnosisTask& task, const FollowProgress& progress,
                                         StageClock* clock);

/// Results of four baseline methods (diagnose/search/structure/baselines.h) for the scenario's
/// first machine, over all blocks. The text has the form of baselines.json: `{"as_it_is": {CHANNEL:
/// RMSE}, "methods": [{"method", "gives_findings", "gives_names", "found", "names": [{"mechanism",
/// "target"}], "rmse": {CHANNEL: RMSE}}]}`. Throws InputError.
std::string BaselinesOfRecording(const Scenario& scenario, const Recording& recording, int threads);

/// One of several recordings, with one diagnosis per machine of the scenario.
struct DiagnosedRecording {
  std::filesystem::path directory;
  std::vector<Diagnosis> machines;
};

/// Diagnoses several recordings of a scenario's machines, one after the other. Each is diagnosed
/// alone, and its findings are validated on all others. Throws InputError before any search if a
/// recording is unreadable or named twice, or if epochs overlap.
std::vector<DiagnosedRecording> DiagnoseRecordings(
    const Scenario& scenario, const std::vector<std::filesystem::path>& recordings,
    const DiagnosisTask& task, const FollowProgress& progress, StageClock* clock);

/// Diagnoses of one machine, in the order of the recordings.
std::vector<const Diagnosis*> OfMachine(const std::vector<DiagnosedRecording>& recordings,
                                        std::size_t machine);

}  // namespace tera
