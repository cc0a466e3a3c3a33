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
  std::string target;                ///< joint or gear
  std::vector<std::string> members;  ///< identifiers; "nothing" for no effect
  bool is_class = false;             ///< class of a finding; else a mechanism that was not testable
  /// Probability that a diagnosis of the run identifies the true member: the minimum over the
  /// members.
  double power = 0;
};

/// A run of levers whose recording would answer this recording's open questions.
struct NextManoeuvre {
  std::string description;  ///< what is driven
  TableRecording commands;  ///< every lever of the machine, as commands.csv has them
  double duration_s = 0;    ///< with the rest at its end
  std::vector<DiscriminatedSet> discriminated, not_discriminated;
  /// Ambiguous joints and gears for which this run has no time.
  std::vector<std::string> deferred;
  double power = 0;  ///< the smallest over `discriminated`
};

struct NextManoeuvreOptions {
  double alpha = 0.01;  ///< as in SearchOptions, over all tests together
  std::size_t total_candidates = 0;
};

/// The block of a joint or gear and its diagnosis.
struct DiagnosedAxis {
  const ReplayBlock* block = nullptr;
  const BlockDiagnosis* diagnosis = nullptr;
};

/// Designs the run that discriminates the hypotheses left open by a diagnosis of joints and gears
/// (greedy_design.h). Axes with a class of causes come first, then those that could not be judged,
/// then those with undetectable mechanisms.
///
/// Model   excitations of each axis (excitation.h) are predicted from the middle of the recorded
///         range. The range is at least the travel of full lever in 0.8 s. They are chosen greedily
///         (greedy_design.h) and driven one after another from the machine's initial position.
///         Where they would leave the range, less a twentieth at either end, they are mirrored or
///         preceded by a move to the middle. Steps are added until a diagnosis has ample
///         manoeuvres. A set with a power of 0.5 (DiscriminationPower) counts as discriminated.
/// Omits   collisions with the ground and with the machine itself, except that the recording
///         reached these positions; base and inertial units; effects of moving several joints at
///         once, beyond the load.
///
/// None if there is no ambiguity, or if no part of it would be discriminated.
std::optional<NextManoeuvre> DesignNextManoeuvre(const MachineModel& model,
                                                 const std::vector<DiagnosedAxis>& blocks,
                                                 const NextManoeuvreOptions& options,
                                                 const Stream& stream);

}  // namespace tera
