#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/stage_clock.h"
#include "diagnose/candidates/candidate_library.h"
#include "diagnose/confirm/held_out_recording.h"
#include "diagnose/confirm/simulate_whole.h"
#include "diagnose/confirm/whole_simulation.h"
#include "diagnose/diagnosed_block.h"
#include "diagnose/discrepancy/discrepancy_correction.h"
#include "diagnose/experiment_design/next_manoeuvre.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/proposal/proposal.h"
#include "diagnose/recorded_blocks.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "diagnose/search/fit/excluded_samples.h"
#include "soil/soil.h"

namespace tera {

/// Why one machine's recording differs from its simulation.
struct Diagnosis {
  std::string machine;                    ///< its name in the recording
  std::string scenario;                   ///< its name in the scenario, to which the overlay speaks
  TimeNs start_ns = 0;                    ///< time in the recording from which all times count
  bool levers_are_the_scenarios = false;  ///< since the recording has none
  std::vector<DiagnosedBlock> blocks;
  /// Time by which encoders run ahead of levers; none where they do not.
  std::optional<double> encoder_lead_s = {};
  std::vector<std::string> not_compared;  ///< measurements that were not compared, and why
  /// Samples at which loose ground may let the base lag behind its tracks.
  std::vector<ExcludedSamples> excluded_samples;
  std::vector<PerceptionDiagnosis> perception;  ///< of sensors that measure ranges
  /// The levers that would resolve what this recording leaves ambiguous; none where nothing is, or
  /// no levers would.
  std::optional<NextManoeuvre> next;
  std::vector<HeldOutRecording> held_out;  ///< further recordings, as they were given
  /// Corrections of predictions for what replays lack of the simulation, one for each channel of
  /// joints, tracks and the base.
  std::vector<DiscrepancyCorrection> discrepancy_corrections;
  std::optional<WholeSimulation> whole;  ///< none where nothing was found, or it was not asked for
  SiteOrigin origin;                     ///< of the scenario's W on the earth, for maps
};

/// The answers of a diagnosis, of which several may hold.
enum class Verdict { kNone, kNamed, kClass, kUnexplained, kUntestable };

/// The verdict's name as in diagnosis.json: "named".
std::string_view NameOf(Verdict verdict);

/// The verdicts of a diagnosis: kNone where nothing was found and nothing is left of the blocks
/// that could be judged; kNamed and kClass by the findings; kUnexplained where error is left;
/// kUntestable where something could not be compared or judged, or a candidate would not have been
/// seen at any size.
std::vector<Verdict> VerdictsOf(const Diagnosis& diagnosis);

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

/// A further recording, which nothing is fitted to, and what is to be made of it.
struct HeldOutCase {
  DiagnosisInput input;
  std::shared_ptr<const Recording> recording;
};

/// One machine of a scenario, its recording, and all else that its diagnosis needs.
struct DiagnosisCase {
  DiagnosisInput input;
  const Recording* recording = nullptr;
  std::vector<HeldOutCase> held_out;
  SimulateMachine simulate;  ///< empty: the scenario is not to be simulated as a whole
  std::vector<PerceptionDiagnosis> perception;  ///< of its sensors that see
  SiteOrigin origin;
};

/// The progress of a diagnosis: before a block, and after it with its diagnosis. Blocks may
/// overlap.
struct BlockProgress {
  std::string machine;
  std::string block;
  std::size_t number = 1, count = 1;
  const BlockDiagnosis* done = nullptr;
};
using FollowProgress = std::function<void(const BlockProgress&)>;

/// Corrects the blocks that the discrepancies belong to.
std::vector<DiscrepancyCorrection> CorrectDiscrepancies(
    const std::vector<ReplayDiscrepancy>& discrepancy, std::uint64_t seed, int threads,
    std::vector<ReplayBlock>* blocks);

/// The random stream of a block's diagnosis.
Stream StreamOf(const ReplayBlock& block, std::uint64_t seed);

/// Search options that correct p-values for the tests of all these blocks together.
SearchOptions WithTotalsOf(SearchOptions options, const std::vector<ReplayBlock>& blocks);

using Deadline = std::chrono::steady_clock::time_point;

/// Diagnoses blocks, as many at a time as there are threads, until a deadline that may be set.
/// Calls of `progress` do not overlap.
std::vector<DiagnosedBlock> DiagnoseBlocks(std::vector<ReplayBlock> blocks,
                                           const SearchOptions& options, std::uint64_t seed,
                                           const FollowProgress& progress,
                                           const std::optional<Deadline>& deadline = {});

/// Whether some block was found to have poses that are stamped as they arrive.
bool FindsArrivalStamps(const std::vector<DiagnosedBlock>& blocks);

/// Why the recording of one machine differs from its simulation: blocks, further recordings, the
/// whole simulation and the levers to drive next. Without a simulation nothing is corrected. The
/// stages are timed by `clock`. Throws InputError where a recording cannot be compared.
Diagnosis Diagnose(DiagnosisCase asked, DiagnosisOptions options, const FollowProgress& progress,
                   StageClock* clock);

/// Validates a diagnosis on the blocks of a held-out recording of this name.
HeldOutRecording ValidateHeldOut(const std::vector<DiagnosedBlock>& diagnosed,
                                 const std::vector<ReplayBlock>& further,
                                 const std::string& recording, std::uint64_t seed);

}  // namespace tera
