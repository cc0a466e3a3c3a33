#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "dataset/format/recording.h"
#include "diagnose/search/block/block_diagnosis.h"
#include "physics/description/machine.h"

namespace tera {

/// Explanations that a run of levers tells apart, or does not.
struct SeparatedMatter {
  std::string target;                ///< joint or gear
  std::vector<std::string> members;  ///< identifiers; "nothing" for no effect
  bool is_class = false;             ///< of a finding that the recording left open
  /// Probability that a recording of the run says which of them holds: the smallest over which one
  /// does.
  double power = 0;
};

/// A run of levers that a recording should have to say what this one does not.
struct NextManoeuvre {
  std::string description;  ///< what is driven
  TableRecording commands;  ///< every lever of the machine, as commands.csv has them
  double duration_s = 0;    ///< with the rest at its end
  std::vector<SeparatedMatter> separates, leaves;
  /// Joints and gears that something is open of and that this run has no time for.
  std::vector<std::string> left_for_later;
  double power = 0;  ///< the smallest of what it separates
};

struct NextManoeuvreOptions {
  double axis_s = 34;  ///< of levers for one joint or gear
  std::size_t most_axes = 3;
  double rest_s = 4;     ///< of all levers at the end: what shows slow noise
  double step_s = 0.01;  ///< of the replay
  double alpha = 0.01;   ///< as the search has it, all tests together
  std::size_t suspects_in_all = 0;
};

/// A diagnosed block and where its axis went.
struct DiagnosedAxis {
  const ReplayBlock* block = nullptr;
  const BlockDiagnosis* diagnosis = nullptr;
};

/// Designs the run that separates what a diagnosis left open of joints and gears (open_question.h):
/// first those with a class of causes, then those that could not be judged, then those with
/// mechanisms that could not be seen.
///
/// Model   courses of each axis (lever_piece.h) are rehearsed from the middle of the room that the
///         recording shows, at least what full lever does in 0.8 s, and chosen greedily
///         (piece_choice.h). They are driven one after another from the machine's initial position,
///         mirrored or after a move to the middle where they would leave the room, which keeps a
///         twentieth on either side; steps are added until a diagnosis has manoeuvres enough.
///         Power: each account is taken for true, the other fitted to it over TRAIN and SELECT of
///         the run, and the tests of rivals (structure_search.h), or of what can be seen
///         (block_diagnosis.h), asked under 100 draws of the block's noise.
/// Omits   the ground and the machine's own parts in the way, other than that the recording was
///         there; base and inertial units; what moving several joints at once would show beyond the
///         load.
///
/// Nothing where nothing is open or nothing of it would be told with a power of a half.
std::optional<NextManoeuvre> DesignNextManoeuvre(const MachineModel& model,
                                                 const std::vector<DiagnosedAxis>& blocks,
                                                 const NextManoeuvreOptions& options,
                                                 const Stream& stream);

}  // namespace tera
