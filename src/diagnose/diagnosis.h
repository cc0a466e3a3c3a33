#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "diagnose/confirm/held_out_recording.h"
#include "diagnose/confirm/whole_simulation.h"
#include "diagnose/diagnosed_block.h"
#include "diagnose/discrepancy/discrepancy_correction.h"
#include "diagnose/experiment_design/next_manoeuvre.h"
#include "diagnose/missing_input.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/search/fit/excluded_samples.h"
#include "diagnose/sensors/diagnosed_sensors.h"
#include "soil/soil.h"

namespace tera {

/// Diagnosis of the differences between one machine's recording and its simulation.
struct Diagnosis {
  std::string machine;                    ///< name in the recording
  std::string scenario;                   ///< name in the scenario and in the overlay
  TimeNs start_ns = 0;                    ///< zero of all times, in the recording's time
  bool levers_are_the_scenarios = false;  ///< true if the recording has no levers of its own
  std::vector<DiagnosedBlock> blocks;
  /// Inertial units, receivers, encoders and poses, compared with each other.
  DiagnosedSensors sensors;
  /// Axes whose motion their levers do not explain; they have no block.
  std::vector<MissingInput> missing_input;
  /// Time by which encoders run ahead of the levers; empty if they do not.
  std::optional<double> encoder_lead_s = {};
  std::vector<std::string> not_compared;  ///< each with the reason
  /// Samples at which the base may lag behind its tracks on loose ground.
  std::vector<ExcludedSamples> excluded_samples;
  /// Diagnoses of lidars, depth cameras and colour cameras.
  std::vector<PerceptionDiagnosis> perception;
  /// Lever motions that would resolve ambiguities of this recording. Empty without ambiguities, or
  /// if no levers would resolve them.
  std::optional<NextManoeuvre> next;
  std::vector<HeldOutRecording> held_out;  ///< validation on further recordings, in the given order
  /// Corrections for the discrepancy of the replays, one per channel of joints, tracks and the
  /// base.
  std::vector<DiscrepancyCorrection> discrepancy_corrections;
  std::optional<WholeSimulation> whole;  ///< empty without findings, or if not requested
  SiteOrigin origin;                     ///< geodetic origin of the scenario's W, for maps
};

/// Verdicts of a diagnosis. Several can hold at once.
enum class Verdict { kNone, kNamed, kClass, kUnexplained, kUntestable };

/// Name of the verdict in diagnosis.json: "named".
std::string_view NameOf(Verdict verdict);

/// The verdicts of a diagnosis. kNone: no finding, and no unexplained error in the judged blocks.
/// kNamed: a finding without rivals. kClass: a finding with rivals. kUnexplained: an error that no
/// mechanism explains. kUntestable: something could not be compared or judged, or a candidate is
/// undetectable at any size.
std::vector<Verdict> VerdictsOf(const Diagnosis& diagnosis);

struct UnexplainedInBlock {
  const DiagnosedBlock* diagnosed = nullptr;
  const Unexplained* unexplained = nullptr;
};

/// Findings of a block, by the share of their channel's mean square error on FINAL that they
/// remove, in descending order. A gain in log-likelihood would rank a faint effect in many
/// manoeuvres above a strong one in few. The diagnosis must outlive the returned pointers.
std::vector<const Finding*> RankedFindings(const DiagnosedBlock& diagnosed);

/// Findings in three lists: within tolerance; selected, but not confirmed on FINAL; nearest to an
/// unexplained error without being its cause (proxies).
std::vector<const Finding*> WithinToleranceOf(const Diagnosis& diagnosis);
std::vector<const Finding*> UnconfirmedOf(const Diagnosis& diagnosis);
std::vector<const Finding*> ProxiesOf(const Diagnosis& diagnosis);

/// Unexplained errors in descending order of the gain in log-likelihood that a flexible regressor
/// reaches.
std::vector<UnexplainedInBlock> RankedUnexplained(const Diagnosis& diagnosis);

/// True if a channel of a block has an unexplained residual.
bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel);

/// The learned table of a channel of a block, or nullptr.
const Learned* LearnedOf(const DiagnosedBlock& diagnosed, std::size_t channel);

/// A finding with its origin: one of `block`, `sensor` and `seen_by` is set.
struct Cause {
  const Finding* finding = nullptr;
  const DiagnosedBlock* block = nullptr;
  const SensorFound* sensor = nullptr;
  const PerceptionDiagnosis* seen_by = nullptr;
  const PerceptionFinding* seen = nullptr;  ///< set together with `seen_by`

  const Mechanism& mechanism() const { return *finding->term.candidate->mechanism; }
  const std::string& target() const { return finding->term.candidate->target; }
  /// SI unit of the errors before and after; "px" for pictures; empty if unknown.
  std::string ErrorUnit() const;
  /// Ratio of the error without the cause to the error with it; 0 if the latter is 0.
  double ErrorRatio() const;
};

/// All causes that a diagnosis names. Causes in blocks come first: blocks by descending total gain
/// in log-likelihood, and the findings of a block in the order of RankedFindings. Causes in sensors
/// that were compared with each other follow. Causes in lidars and cameras come last.
std::vector<Cause> RankedCauses(const Diagnosis& diagnosis);

/// The same causes, sorted by descending ErrorRatio.
std::vector<Cause> CausesOf(const Diagnosis& diagnosis);

/// Channels of sensors that were compared with each other, if no sensor parameter explains their
/// residual. Channels that a testable block judges are left out.
std::vector<const ChannelError*> UnexplainedOfSensors(const Diagnosis& diagnosis);

/// Other candidates that explain the error as well as the finding's own.
std::vector<const Candidate*> RivalsOf(const Finding& finding);

}  // namespace tera
