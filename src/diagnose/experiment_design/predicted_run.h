#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "dataset/format/recording.h"
#include "diagnose/experiment_design/excitation.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

namespace tera {

/// A future run of levers, predicted in the form of a recording.
struct PredictedRun {
  TableRecording commands;
  NamedEncoders encoders;       ///< measurements of all joints and running gears
  std::vector<double> end_rad;  ///< joint positions at the end
  std::vector<double> lowest_rad, highest_rad;
  double length_s = 0;
};

/// Predicts a machine's motion under moves of its levers, from given positions of its joints.
///
/// Model   the chain of actuation with the model's effects; a joint follows its drive's demand.
///         Encoders measure it every `period_s`, with only as much noise as keeps two samples from
///         being equal.
/// Omits   inertia, end stops, the ground.
PredictedRun PredictRun(const MachineModel& model, const std::vector<LeverMove>& moves,
                        double length_s, std::vector<double> start_rad,
                        double period_s = kReplayStep_s);

/// Runs joined in time. Each run starts from its own positions.
PredictedRun Concatenated(const std::vector<PredictedRun>& runs);

/// Block of an axis over a predicted run. Returns nothing if the run is too short.
std::optional<ReplayBlock> BlockOf(const MachineModel& model, const PredictedRun& run,
                                   std::size_t axis);

}  // namespace tera
