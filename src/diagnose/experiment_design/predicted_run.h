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

struct PredictionSteps {
  double step_s = 0.01;    ///< time step of the replay
  double period_s = 0.01;  ///< sample period of the encoders
};

/// Predicts a machine's motion under lever moves, from given joint positions.
///
/// Model   The actuation chain with the model's effects. Joints follow the rates that their drives
///         demand. Encoders add a tremor of 1e-9 rad/s, so that no two consecutive samples are
///         equal.
/// Omits   Inertia, end stops, the ground.
PredictedRun PredictRun(const MachineModel& model, const std::vector<LeverMove>& moves,
                        double length_s, std::vector<double> start_rad,
                        const PredictionSteps& steps);

/// Runs joined in time. Each run starts from its own positions.
PredictedRun Concatenated(const std::vector<PredictedRun>& runs);

/// Block of an axis over a predicted run. Returns nothing if the run is too short.
std::optional<ReplayBlock> BlockOf(const MachineModel& model, const PredictedRun& run,
                                   std::size_t axis, double step_s);

}  // namespace tera
