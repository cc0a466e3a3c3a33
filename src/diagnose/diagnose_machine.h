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
  std::optional<CandidateLibrary> library;  ///< limits or extends the blocks' own
  /// Limit of the search. Blocks that are not done by then are not judged, so that the answer
  /// depends on the computer; where the limit is not reached the answer is the same as without one.
  std::optional<double> time_limit_s;
};

/// One machine of a scenario, its recording, and all else that its diagnosis needs.
struct DiagnosisCase {
  DiagnosisInput input;
  const Recording* recording = nullptr;
  std::vector<HeldOutCase> held_out;
  SimulateMachine simulate;  ///< empty: the scenario is not to be simulated as a whole
  std::vector<PerceptionDiagnosis> perception;  ///< of its sensors that see
  SiteOrigin origin;
  KnownPlace place;  ///< of the machine, beside its measurements
};

/// Why the recording of one machine differs from its simulation: blocks, further recordings, the
/// whole simulation and the levers to drive next. Without a simulation nothing is corrected. The
/// stages are timed by `clock`. Throws InputError where a recording cannot be compared.
Diagnosis Diagnose(DiagnosisCase asked, DiagnosisOptions options, const FollowProgress& progress,
                   StageClock* clock);

}  // namespace tera
