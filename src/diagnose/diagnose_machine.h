#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/stage_clock.h"
#include "dataset/format/recording.h"
#include "diagnose/candidates/candidate_library.h"
#include "diagnose/confirm/simulate_whole.h"
#include "diagnose/confirm/validate_held_out.h"
#include "diagnose/diagnose_blocks.h"
#include "diagnose/diagnosis.h"
#include "diagnose/recorded_blocks.h"

namespace tera {

struct DiagnosisOptions {
  MeasurementOptions measurements;
  BlockOptions blocks;
  SearchOptions search;
  std::uint64_t seed = 1;
  std::optional<CandidateLibrary> library;  ///< restricts or extends the blocks' candidates
  /// Time limit of the search. Blocks that are unfinished at the limit are not judged, so the
  /// result depends on the computer's speed. If the search ends before the limit, the result is the
  /// same as without one.
  std::optional<double> time_limit_s;
};

/// Inputs of the diagnosis of one machine.
struct DiagnosisCase {
  DiagnosisInput input;
  const Recording* recording = nullptr;
  std::vector<HeldOutCase> held_out;
  SimulateMachine simulate;                     ///< empty: the whole scenario is not simulated
  std::vector<PerceptionDiagnosis> perception;  ///< diagnoses of the machine's lidars and cameras
  SiteOrigin origin;
  KnownPlace place;  ///< initial pose and ground in the scenario
};

/// Diagnoses one machine: its blocks, further recordings, the whole simulation and the next
/// manoeuvre. Without a simulation, replays are not corrected for their discrepancy. `clock` times
/// the stages. Throws InputError if a recording cannot be compared.
Diagnosis Diagnose(DiagnosisCase asked, DiagnosisOptions options, const FollowProgress& progress,
                   StageClock* clock);

}  // namespace tera
