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

/// The part of a recording to be diagnosed, and the options of its diagnosis.
struct DiagnosisTask {
  std::vector<std::filesystem::path> held_out;  ///< further recordings, for validation
  std::optional<CandidateLibrary> library;      ///< restricts or extends the blocks' own candidates
  std::optional<double> from_s, to_s, time_limit_s;
  bool simulate = true;  ///< whether the whole scenario is simulated as well
  int threads = 1;
};

/// Throws InputError where the epochs of two recordings overlap, as for one drive that was recorded
/// twice: the validation would use data of the fit. Without epochs an overlap remains unknown.
void RequireOtherTime(const Recording& one, const Recording& other);

/// Diagnoses the differences between a recording and a scenario: one diagnosis for each machine,
/// with its joints, tracks, base and sensors. `progress` follows the blocks, `clock` times the
/// stages. Throws InputError where the recording cannot be compared.
std::vector<Diagnosis> DiagnoseRecording(const Scenario& scenario, const Recording& recording,
                                         const DiagnosisTask& task, const FollowProgress& progress,
                                         StageClock* clock);

/// Answers of four baseline methods (diagnose/search/structure/baselines.h) for the scenario's
/// first machine, as the text of baselines.json: `{"as_it_is": {CHANNEL: RMSE}, "methods":
/// [{"method", "gives_findings", "gives_names", "found", "names": [{"mechanism", "target"}],
/// "rmse": {CHANNEL: RMSE}}]}`, over all blocks. Throws InputError.
std::string BaselinesOfRecording(const Scenario& scenario, const Recording& recording, int threads);

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
