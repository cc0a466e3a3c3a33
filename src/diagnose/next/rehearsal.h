#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "dataset/format/recording.h"
#include "diagnose/next/lever_piece.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

namespace tera {

/// A run of levers that has not been driven yet, as a recording would hold it.
struct Rehearsal {
  TableRecording commands;
  NamedEncoders encoders;       ///< of all joints and gears
  std::vector<double> end_rad;  ///< where the joints are at its end
  std::vector<double> lowest_rad, highest_rad;
  double length_s = 0;
};

/// How finely runs are rehearsed.
struct RehearsalSteps {
  double step_s = 0.01, period_s = 0.01;  ///< of the replay, of the encoders
};

/// The axis of a joint or gear by its name, joints first; -1 where there is none.
int AxisNamed(const MachineModel& model, const std::string& name);

/// Drives a machine, in thought, by moves of its levers from given positions of its joints.
///
/// Model   the chain of actuation with the model's effects; a joint runs as its drive asks, and
///         encoders measure it without noise but for what keeps two samples from being the same.
/// Omits   inertia, end stops, the ground.
Rehearsal Rehearse(const MachineModel& model, const std::vector<LeverMove>& moves, double length_s,
                   std::vector<double> start_rad, const RehearsalSteps& steps);

/// One run after the other, each from its own positions.
Rehearsal Joined(const std::vector<Rehearsal>& runs);

/// The block of an axis over a rehearsed run; nothing where it is too short for one.
std::optional<ReplayBlock> BlockOf(const MachineModel& model, const Rehearsal& rehearsal,
                                   std::size_t axis, double step_s);

}  // namespace tera
