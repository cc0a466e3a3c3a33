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
  std::optional<CandidateLibrary> library;      ///< limits or extends the blocks' own
  std::optional<double> from_s, to_s, time_limit_s;
  bool simulate = true;  ///< whether the whole scenario is simulated as well
  int threads = 1;
};

/// Throws InputError where two recordings are of the same time by their epochs, as of one drive
/// that was recorded twice: one would be judged by what was fitted to it. Without epochs that is
/// not known.
void RequireOtherTime(const Recording& one, const Recording& other);

/// Diagnoses why a recording differs from a scenario: one diagnosis for each machine of the
/// scenario, of its joints, tracks and base, and of its sensors. `progress` follows the blocks,
/// `clock` times the stages. Throws InputError where the recording cannot be compared.
std::vector<Diagnosis> DiagnoseRecording(const Scenario& scenario, const Recording& recording,
                                         const DiagnosisTask& task, const FollowProgress& progress,
                                         StageClock* clock);

/// The answers of four simpler methods (diagnose/search/structure/baselines.h) for the scenario's
/// first machine, as the text of baselines.json. Throws InputError.
std::string BaselinesOfRecording(const Scenario& scenario, const Recording& recording, int threads);

}  // namespace tera
