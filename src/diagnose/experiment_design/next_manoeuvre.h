#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "dataset/format/recording.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "physics/description/machine.h"

namespace tera {

/// An ambiguity set, and how surely a run of levers resolves it.
struct DiscriminatedSet {
  std::string target;                ///< joint or gear
  std::vector<std::string> members;  ///< identifiers; "nothing" for no effect
  bool is_class = false;             ///< of a finding; else of a mechanism that was not testable
  /// Probability that a diagnosis of the run says which member holds: the smallest over which one
  /// does.
  double power = 0;
};

/// A run of levers that a recording should have to say what this one does not.
struct NextManoeuvre {
  std::string description;  ///< what is driven
  TableRecording commands;  ///< every lever of the machine, as commands.csv has them
  double duration_s = 0;    ///< with the rest at its end
  std::vector<DiscriminatedSet> discriminated, not_discriminated;
  /// Ambiguous joints and gears that this run has no time for.
  std::vector<std::string> deferred;
  double power = 0;  ///< the smallest over `discriminated`
};

struct NextManoeuvreOptions {
  double rest_s = 4;     ///< of all levers at the end, which shows slow noise
  double step_s = 0.01;  ///< of the replay
  double alpha = 0.01;   ///< as in SearchOptions, all tests together
  std::size_t total_candidates = 0;
};

/// The block of a joint or gear and its diagnosis.
struct DiagnosedAxis {
  const ReplayBlock* block = nullptr;
  const BlockDiagnosis* diagnosis = nullptr;
};

/// Designs the run that discriminates the explanations between which a diagnosis of joints and
/// gears did not decide (ambiguity_set.h). Axes with a class of causes come first, then those that
/// could not be judged, then those with mechanisms that could not be seen.
///
/// Model   excitations of each axis (excitation.h) are predicted from the middle of the range that
///         the recording shows, at least what full lever does in 0.8 s, and chosen greedily
///         (greedy_design.h). They are driven one after another from the machine's initial
///         position, mirrored or after a move to the middle where they would leave the range, of
///         which a twentieth is kept free on either side. Steps are added until a diagnosis has
///         ample manoeuvres. What has a power of a half (discrimination_power.h) counts as
///         discriminated.
/// Omits   the ground and the machine's own parts in the way, other than that the recording was
///         there; base and inertial units; what moving several joints at once would show beyond the
///         load.
///
/// None where nothing is ambiguous or nothing of it would be discriminated.
std::optional<NextManoeuvre> DesignNextManoeuvre(const MachineModel& model,
                                                 const std::vector<DiagnosedAxis>& blocks,
                                                 const NextManoeuvreOptions& options,
                                                 const Stream& stream);

}  // namespace tera
