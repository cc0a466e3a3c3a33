#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "dataset/format/recording.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "physics/description/machine.h"

namespace tera {

/// An ambiguity set, and the probability that a run of levers resolves it.
struct DiscriminatedSet {
  std::string target;                ///< joint or running gear
  std::vector<std::string> members;  ///< mechanisms; "nothing" for no effect
  bool is_class = false;  ///< true: a finding and its rivals; false: an undetectable mechanism
  /// Probability that a diagnosis of the run identifies the true member: the minimum over the set's
  /// pairs.
  double power = 0;
};

/// Lever motions to record next. The new recording would answer open questions of the present one.
struct NextManoeuvre {
  std::string description;  ///< the excitations of each axis
  TableRecording commands;  ///< every lever of the machine, as in commands.csv
  double duration_s = 0;    ///< including the rest at its end
  std::vector<DiscriminatedSet> discriminated, not_discriminated;
  /// Ambiguous joints and running gears for which this run has no time.
  std::vector<std::string> deferred;
  double power = 0;  ///< smallest power in `discriminated`
};

struct NextManoeuvreOptions {
  double alpha = 0.01;  ///< as in SearchOptions, over all tests together
  std::size_t total_candidates = 0;
};

/// Block of a joint or running gear, with its diagnosis.
struct DiagnosedAxis {
  const ReplayBlock* block = nullptr;
  const BlockDiagnosis* diagnosis = nullptr;
};

/// Designs lever motions that discriminate the hypotheses which a diagnosis of joints and running
/// gears left open. Axes with an ambiguous finding come first. Axes that could not be judged
/// follow, then axes with undetectable mechanisms.
///
/// Model   Excitations of each axis (excitation.h) are predicted from the middle of its recorded
///         range. The range is at least the travel of 0.8 s at full lever. The choice is greedy
///         (greedy_design.h). The chosen excitations run one after another, from the machine's
///         initial position.
///         An excitation that would leave the range is mirrored, or preceded by a move to the
///         middle. A margin of a twentieth of the range stays free at either end. Steps are added
///         until a diagnosis has ample manoeuvres. A set counts as discriminated at a power of at
///         least 0.5 (DiscriminationPower).
/// Omits   Collisions with the ground and with the machine itself, except that the recording
///         reached these positions; base and inertial units; effects of several moving joints
///         beyond the load.
///
/// Returns nothing if there is no ambiguity, or if no set would be discriminated.
std::optional<NextManoeuvre> DesignNextManoeuvre(const MachineModel& model,
                                                 const std::vector<DiagnosedAxis>& blocks,
                                                 const NextManoeuvreOptions& options,
                                                 const Stream& stream);

}  // namespace tera
