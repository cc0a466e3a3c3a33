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
  std::string machine;                    ///< its name in the recording
  std::string scenario;                   ///< its name in the scenario, which the overlay uses
  TimeNs start_ns = 0;                    ///< time in the recording to which all times refer
  bool levers_are_the_scenarios = false;  ///< the recording has none
  std::vector<DiagnosedBlock> blocks;
  DiagnosedSensors sensors;  ///< comparison of units, receivers, encoders and poses with each other
  std::vector<MissingInput> missing_input;  ///< axes that their levers do not explain; not searched
  /// Time by which encoders run ahead of levers; empty if they do not.
  std::optional<double> encoder_lead_s = {};
  std::vector<std::string> not_compared;  ///< measurements that were not compared, with the reason
  /// Samples at which loose ground may let the base lag behind its tracks.
  std::vector<ExcludedSamples> excluded_samples;
  std::vector<PerceptionDiagnosis> perception;  ///< of ranging sensors and cameras
  /// Levers that would resolve the ambiguities of this recording. Empty if there are no
  /// ambiguities, or if no levers would resolve them.
  std::optional<NextManoeuvre> next;
  std::vector<HeldOutRecording> held_out;  ///< further recordings, in the given order
  /// Corrections of predictions for the replay's discrepancy, one for each channel of joints,
  /// tracks and the base.
  std::vector<DiscrepancyCorrection> discrepancy_corrections;
  std::optional<WholeSimulation> whole;  ///< none without findings, or if not requested
  SiteOrigin origin;                     ///< geodetic origin of the scenario's W, for maps
};

/// Verdicts of a diagnosis; several may hold.
enum class Verdict { kNone, kNamed, kClass, kUnexplained, kUntestable };

/// The verdict's name as in diagnosis.json: "named".
std::string_view NameOf(Verdict verdict);

/// The verdicts of a diagnosis. kNone: no finding, and no error left in the blocks that could be
/// judged. kNamed and kClass: by the findings. kUnexplained: error is left. kUntestable: something
/// could not be compared or judged, or a candidate is undetectable at any size.
std::vector<Verdict> VerdictsOf(const Diagnosis& diagnosis);

/// An unexplained error with its block.
struct UnexplainedInBlock {
  const DiagnosedBlock* diagnosed = nullptr;
  const Unexplained* unexplained = nullptr;
};

/// Findings of a block, by descending removed error of their channel on FINAL. The gain in
/// log-likelihood would instead rank an effect that is faint in many manoeuvres above one that is
/// strong in few. The diagnosis must outlive the returned pointers.
std::vector<const Finding*> RankedFindings(const DiagnosedBlock& diagnosed);

/// Findings of all blocks in three lists: findings within tolerance; chosen findings that FINAL
/// does not confirm; mechanisms that come nearest to an unexplained error but are not its cause
/// (proxies).
std::vector<const Finding*> WithinToleranceOf(const Diagnosis& diagnosis);
std::vector<const Finding*> UnconfirmedOf(const Diagnosis& diagnosis);
std::vector<const Finding*> ProxiesOf(const Diagnosis& diagnosis);

/// Unexplained errors, by the gain in log-likelihood that a flexible regressor reaches.
std::vector<UnexplainedInBlock> RankedUnexplained(const Diagnosis& diagnosis);

/// Whether a channel of a block has an unexplained residual.
bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel);

/// A finding with its origin: one of `block`, `sensor` and `seen_by` is set.
struct Cause {
  const Finding* finding = nullptr;
  const DiagnosedBlock* block = nullptr;
  const SensorFound* sensor = nullptr;
  const PerceptionDiagnosis* seen_by = nullptr;
  const PerceptionFinding* seen = nullptr;  ///< together with `seen_by`

  const Mechanism& mechanism() const { return *finding->term.candidate->mechanism; }
  const std::string& target() const { return finding->term.candidate->target; }
  /// SI unit of the errors before and after; "px" for pictures; empty if unknown.
  std::string ErrorUnit() const;
  /// Ratio of the error without the cause to that with it.
  double ErrorRatio() const;
};

/// All causes that a diagnosis names. Causes in blocks come first: blocks by descending total gain
/// in log-likelihood on held-out samples, and the findings of a block in the order of
/// RankedFindings. Causes in sensors that were compared with each other follow. Causes in lidars
/// and cameras come last.
std::vector<Cause> RankedCauses(const Diagnosis& diagnosis);

/// The same, sorted by descending ErrorRatio.
std::vector<Cause> CausesOf(const Diagnosis& diagnosis);

/// Channels of sensors that were compared with each other, with a residual that no sensor parameter
/// explains. Channels that a testable block judges are left out.
std::vector<const ChannelError*> UnexplainedOfSensors(const Diagnosis& diagnosis);

/// Other candidates that explain as well as the finding.
std::vector<const Candidate*> RivalsOf(const Finding& finding);

}  // namespace tera
