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

/// Why one machine's recording differs from its simulation.
struct Diagnosis {
  std::string machine;                    ///< its name in the recording
  std::string scenario;                   ///< its name in the scenario, to which the overlay speaks
  TimeNs start_ns = 0;                    ///< time in the recording from which all times count
  bool levers_are_the_scenarios = false;  ///< since the recording has none
  std::vector<DiagnosedBlock> blocks;
  DiagnosedSensors sensors;  ///< units, receivers, encoders and poses beside each other
  std::vector<MissingInput> missing_input;  ///< axes whose levers explain nothing, not searched
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

}  // namespace tera
