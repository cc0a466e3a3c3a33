#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"
#include "resimulate/motion/simulated_course.h"

namespace tera {

/// Samples of error-free encoders in the simulation, for the axes and times of `measured`, up to
/// the end of the simulation. Axes that the machine lacks keep their measurements.
std::vector<NamedEncoders> AsSimulated(const MachineModel& model, const SimulatedCourse& course,
                                       std::vector<NamedEncoders> measured);

/// Simulated poses at the times of the measured poses, within the time of the simulation.
std::vector<TruthPose> AsSimulated(const SimulatedCourse& course,
                                   const std::vector<TruthPose>& measured);

/// The channels of a block in a simulation of the whole scenario, minus the block's replay of that
/// simulation. The difference contains effects of soil, other joints and inertia that the replay
/// lacks.
struct ReplayDiscrepancy {
  std::string first_channel;                  ///< identifies the block
  std::vector<std::vector<double>> channels;  ///< simulated minus replayed, on the block's grid
};

/// Correction of one channel for the replay's discrepancy.
struct DiscrepancyCorrection {
  std::string channel, unit;
  bool is_simulated = false;  ///< false: the discrepancy is unknown
  double rms = 0;
  double gain = 0;  ///< gain in log-likelihood on TRAIN and SELECT, without any term
  bool is_applied() const { return gain > 0; }
};

/// Adds the replay's discrepancy to a block's predictions under every structure. The recording is
/// then compared with the simulation itself, and not with a replay that lacks some of its physics.
///
/// Model   prediction + a (simulated - replayed). A channel is corrected if that raises the
///         likelihood of TRAIN and SELECT, without any term in either case. The scale a is a
///         nuisance (likelihood.h) with mean 1 and standard deviation 0.25, because a mechanism
///         that slows the machine also reduces the discrepancy.
/// Omits   the influence of mechanisms on the discrepancy: the discrepancy comes from a simulation
///         without them.
/// Source  Kennedy and O'Hagan 2001, "Bayesian calibration of computer models" (the discrepancy
///         term; here it is computed, not estimated).
std::vector<DiscrepancyCorrection> CorrectDiscrepancy(const ReplayDiscrepancy& discrepancy,
                                                      const Stream& stream, ReplayBlock* block);

}  // namespace tera
