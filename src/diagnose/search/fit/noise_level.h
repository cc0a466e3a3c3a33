#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Noise of a channel, estimated without a fit.
struct NoiseLevel {
  std::optional<double> at_rest;  ///< RMS of the residual at rest, without commands
  double differences = 0;         ///< deviation by third differences of the residual
  double rms() const { return std::max(at_rest.value_or(0), differences); }
};

/// Noise of a channel's residual over the samples of a mask.
///
/// Model   At rest: RMS of samples at least 1.5 s after the last command, if they last at least 2
///         s. Differences: robust scale of third differences, whose variance is 20 times that of
///         white noise. It ignores tails: the RMS of Student-t noise with 3 degrees of freedom is
///         1.5 times as large.
/// Omits   slow noise that occurs only during motion. Neither estimate shows it, so it counts as
///         error.
NoiseLevel NoiseLevelOf(const ReplayBlock& block, std::size_t channel, const Series& residual,
                        const Mask& mask);

}  // namespace tera
