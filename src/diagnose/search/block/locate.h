#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/noise_level.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/regime/curve_shape.h"
#include "diagnose/statistics/regime/regime_curve.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

/// A variable on which a channel's error depends, and the curve of that dependence.
struct Regime {
  std::string variable;
  bool is_share = false;  ///< curve of error over simulated value, instead of error
  double p = 1;           ///< Holm-corrected over the variables; uncorrected with too few shifts
  double share = 0;       ///< explained share of the whitened residual's energy
  CurveShape shape;
  RegimeCurve curve;
};

/// Where a channel's error occurs: in time, and over the channel's variables.
struct Location {
  std::size_t channel = 0;
  std::vector<Segment> intervals;  ///< sample indices
  std::size_t worst = 0;           ///< index of the interval with most error beyond noise
  std::vector<Regime> regimes;     ///< best regressor first, each given the previous ones
};

/// Each variable of a channel twice: as the argument of an additive error, and of an error in
/// proportion to the simulated value.
std::vector<RegimeVariable> VariablesAndShares(const Channel& channel, const Series& residual);

/// The variable over which a residual has most structure (UnexplainedOf).
struct LeadingVariable {
  std::size_t index = 0;  ///< index in VariablesAndShares
  double p = 1;
  double gain = 0;  ///< gain of its curve in log-likelihood on SELECT
};

/// Locates the residual of a channel in time and over the channel's variables.
///
/// Model   Time (change_points.h, level 1 %): intervals in which innovations exceed noise, and
///         intervals in which the level of the residual does. The unit of the level is the larger
///         deviation of single samples and of long means. It is limited to three times the noise at
///         rest or, without rest, ten times the noise by third differences.
///
///         Variables (partialling.h, regime_curve.h): the error is a function of the variable, or
///         the simulated value times such a function. Both are tested against the noise. A residual
///         above three times the noise (ten times without rest) is tested against white noise of
///         its own size.
///
///         Order: `leading` comes first, with its own p. Without it, an insignificant variable
///         comes first if it explains 1.3 times as much as the best significant one, or 2 % where
///         none is significant. It keeps its uncorrected p. Reason: time and rarely revisited
///         places have too few shifts for a small p. Variables that explain at least 95 % as much
///         as the largest are ordered by p.
/// Omits   autocorrelation of a slow residual, which shows the shape of a curve less well than
///         white noise with as many samples.
Location Locate(const Channel& channel, std::size_t index, const Series& residual,
                const NoiseModel& noise, const NoiseLevel& level, const Stream& stream,
                int threads = 2, const std::optional<LeadingVariable>& leading = {});

}  // namespace tera
