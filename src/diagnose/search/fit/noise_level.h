#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The level of a channel's noise, estimated without a fit.
struct NoiseLevel {
  std::optional<double> at_rest;  ///< RMS of the residual where no command is given
  double differences = 0;         ///< standard deviation by third differences of the residual
  double rms() const { return std::max(at_rest.value_or(0), differences); }
};

/// The noise of a channel's residual among the samples of a mask.
///
/// Model   at rest: RMS of samples at least 1.5 s after the last command, 2 s of them or none.
///         Differences: the robust scale of third differences, which have 20 times the variance of
///         white noise. It leaves tails out: noise of Student's t with 3 degrees of freedom has an
///         RMS 1.5 times as large.
/// Omits   slow noise that motion alone makes: neither estimate shows it, so that it counts as
///         error.
NoiseLevel NoiseLevelOf(const ReplayBlock& block, std::size_t channel, const Series& residual,
                        const Mask& mask);

}  // namespace tera
