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
  std::optional<CandidateLibrary> library;  ///< restricts or extends the blocks' own candidates
  /// Time limit of the search. Unfinished blocks are not judged, so that the answer depends on the
  /// computer's speed. If the limit is not reached, the answer is the same as without one.
  std::optional<double> time_limit_s;
};

/// One machine of a scenario, its recording, and the other inputs of its diagnosis.
struct DiagnosisCase {
  DiagnosisInput input;
  const Recording* recording = nullptr;
  std::vector<HeldOutCase> held_out;
  SimulateMachine simulate;                     ///< empty: no simulation of the whole scenario
  std::vector<PerceptionDiagnosis> perception;  ///< of its perception sensors
  SiteOrigin origin;
  KnownPlace place;  ///< the machine's place, besides its measurements
};

/// Diagnoses one machine: blocks, further recordings, the whole simulation and the next manoeuvre.
/// Without a simulation nothing is corrected. `clock` times the stages. Throws InputError where a
/// recording cannot be compared.
Diagnosis Diagnose(DiagnosisCase asked, DiagnosisOptions options, const FollowProgress& progress,
                   StageClock* clock);

}  // namespace tera
