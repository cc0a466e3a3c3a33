#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/stage_clock.h"
#include "dataset/format/recording.h"
#include "diagnose/diagnosis.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// What of a recording is diagnosed, by what, and how thoroughly.
struct DiagnosisTask {
  std::vector<std::filesystem::path> held_out;  ///< further recordings, to be judged by
  std::optional<CandidateLibrary> library;      ///< instead of what the blocks candidate themselves
  std::optional<double> from_s, to_s, time_limit_s;
  bool simulate = true;  ///< the whole scenario, to confirm what was found
  int threads = 1;
};

/// Reads the scenario that is diagnosed, each time anew.
using ReadAgain = std::function<Scenario()>;

/// Why a recording differs from a scenario: one diagnosis for each machine of the scenario, of its
/// joints, tracks and base, and of what its sensors show. `progress` is told of the blocks, `clock`
/// of the stages. Throws InputError where the recording is not what can be compared.
std::vector<Diagnosis> DiagnoseRecording(Scenario scenario, const ReadAgain& again,
                                         const Recording& recording, const DiagnosisTask& task,
                                         const FollowProgress& progress, StageClock* clock);

/// What four simpler methods make of it, as baselines.json has it
/// (diagnose/search/structure/baselines.h), of the scenario's first machine. Throws InputError.
std::string BaselinesOfRecording(const Scenario& scenario, const Recording& recording, int threads);

}  // namespace tera
