#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The difference between a block's channels in a simulation of the whole scenario and the block's
/// replay over that simulation: effects of soil, other joints and inertia that a replay of one
/// block lacks.
struct ReplayDiscrepancy {
  std::string first_channel;                  ///< the block's, by which it is recognised
  std::vector<std::vector<double>> channels;  ///< simulated less replayed, on the block's grid
};

/// The correction of one channel's prediction for the replay's discrepancy.
struct DiscrepancyCorrection {
  std::string channel, unit;
  bool is_simulated = false;  ///< else the discrepancy is not known
  double rms = 0;             ///< of the discrepancy
  double gain = 0;  ///< of log-likelihood by the correction, on TRAIN and SELECT, without any term
  bool is_applied() const { return gain > 0; }
};

/// Adds the replay's discrepancy to what a block predicts under any structure. The recording is
/// then compared with the simulation, which the question is about, and not with a replay that lacks
/// some of its physics.
///
/// Model   prediction + a (simulated - replayed over the simulation), channel by channel, where the
///         measurements of TRAIN and SELECT are likelier with it than without, both without any
///         term. The scale a is a nuisance (likelihood.h) of 1 with a standard deviation of a
///         quarter: an effect that makes the machine slower leaves less of the discrepancy.
/// Omits   that effects change the discrepancy's course over time: it is that of the simulation
///         without them.
/// Source  Kennedy and O'Hagan 2001, "Bayesian calibration of computer models" (the discrepancy
///         term; here it is computed, not estimated).
std::vector<DiscrepancyCorrection> CorrectDiscrepancy(const ReplayDiscrepancy& discrepancy,
                                                      const Stream& stream, ReplayBlock* block);

}  // namespace tera
