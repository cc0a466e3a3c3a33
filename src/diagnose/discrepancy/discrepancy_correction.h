#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"
#include "resimulate/motion/simulated_course.h"

namespace tera {

/// Samples of error-free encoders in the simulation, for the axes and times of `measured`, up to
/// the simulation's end. Axes that the machine lacks keep their measurements.
std::vector<NamedEncoders> AsSimulated(const MachineModel& model, const SimulatedCourse& course,
                                       std::vector<NamedEncoders> measured);

/// Simulated poses at the times of the measured ones, up to the simulation's end.
std::vector<TruthPose> AsSimulated(const SimulatedCourse& course,
                                   const std::vector<TruthPose>& measured);

/// Difference of a block's channels between a simulation of the whole scenario and the block's
/// replay of that simulation. It holds effects of soil, other joints and inertia that the replay
/// lacks.
struct ReplayDiscrepancy {
  std::string first_channel;                  ///< identifies the block
  std::vector<std::vector<double>> channels;  ///< simulated minus replayed, on the block's grid
};

/// The correction of one channel's prediction for the replay's discrepancy.
struct DiscrepancyCorrection {
  std::string channel, unit;
  bool is_simulated = false;  ///< false: the discrepancy is unknown
  double rms = 0;             ///< of the discrepancy
  double gain = 0;            ///< gain in log-likelihood, on TRAIN and SELECT, without any term
  bool is_applied() const { return gain > 0; }
};

/// Adds the replay's discrepancy to a block's prediction under every structure. The recording is
/// then compared with the simulation itself, which the question concerns, and not with a replay
/// that lacks some of its physics.
///
/// Model   prediction + a (simulated - replayed). Each channel is corrected if that raises the
///         likelihood of the measurements of TRAIN and SELECT, with no term in either case. The
///         scale a is a nuisance (likelihood.h) with mean 1 and standard deviation 0.25, since an
///         effect that slows the machine leaves less of the discrepancy.
/// Omits   effects' influence on the discrepancy's course over time: it is that of the simulation
///         without them.
/// Source  Kennedy and O'Hagan 2001, "Bayesian calibration of computer models" (the discrepancy
///         term; here it is computed, not estimated).
std::vector<DiscrepancyCorrection> CorrectDiscrepancy(const ReplayDiscrepancy& discrepancy,
                                                      const Stream& stream, ReplayBlock* block);

}  // namespace tera
