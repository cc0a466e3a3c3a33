#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// What the simulation of the whole scenario, as it is, does in a block's channels and a replay of
/// the block alone, over that simulation, does not.
struct Unreplayed {
  std::string first_channel;                  ///< of the block, which it tells by
  std::vector<std::vector<double>> channels;  ///< on the block's grid
};

/// What came of it for one channel.
struct TakenOff {
  std::string channel, unit;
  bool is_simulated = false;  ///< else nothing is known
  double rms = 0;             ///< of what the replay leaves of the simulation
  double gain = 0;            ///< of log-likelihood by it, on TRAIN and SELECT, were nothing wrong
  bool is_taken() const { return gain > 0; }
};

/// Adds to what a block predicts, of any structure, what its replay leaves of the simulation: then
/// the block is compared with the simulation, which the question is about, and no more with a
/// replay that lacks some of its physics.
///
/// Model   of each channel for itself, and only where the measurements of TRAIN and SELECT are
///         likelier with it, nothing being wrong, than without it. How much of it there is, is a
///         nuisance (likelihood.h) of 1 with a standard deviation of a quarter: an effect that
///         makes the machine slower leaves less of it.
/// Omits   that effects change its course over time: it is that of the simulation without them.
std::vector<TakenOff> TakeOff(const Unreplayed& unreplayed, const Stream& stream,
                              ReplayBlock* block);

}  // namespace tera
