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

/// A variable on which a channel's error depends, and the form of that dependence.
struct Regime {
  std::string variable;
  bool is_share = false;  ///< the curve is the ratio of error to simulated value
  double p = 1;           ///< by Holm over the variables; unadjusted if there are too few shifts
  double share = 0;       ///< share of the whitened residual's energy that it explains
  CurveShape shape;
  RegimeCurve curve;
};

/// Where a channel's error occurs: in time and over the channel's variables.
struct Location {
  std::size_t channel = 0;
  std::vector<Segment> intervals;  ///< in samples
  std::size_t worst = 0;           ///< index of the interval with the most error beyond noise
  std::vector<Regime> regimes;     ///< the best regressor first; each given the previous ones
};

/// A channel's variables, each twice: as argument of an additive error, and of a share of the
/// simulated value.
std::vector<RegimeVariable> VariablesAndShares(const Channel& channel, const Series& residual);

/// A variable over which a residual is known to have structure.
struct LeadingVariable {
  std::size_t index = 0;  ///< among VariablesAndShares
  double p = 1;
  double gain = 0;  ///< of its curve in log-likelihood, on SELECT
};

/// Locates the residual of a channel in time and over the channel's variables.
///
/// Model   In time (change_points.h), at 1 %: intervals where innovations differ from noise, and
///         intervals where the residual's own level does. The level is relative to the noise's
///         deviation, of a sample or of long means, whichever is larger. Its bound is three times
///         the noise at rest or, without rest, ten times the estimate from third differences.
///         By variable (partialling.h, regime_curve.h): the error as a function of each variable,
///         and as the simulated value times such a function, tested against the noise. A residual
///         of three times the noise (ten times without rest) is tested against white noise of its
///         own size.
///         Order: `leading` comes first, with its own p. Without it, a variable without
///         significance comes first, with its unadjusted p, if it
///         explains 1.3 times as much as the best significant one. Without any significant one, 2 %
///         suffice. Time and seldom revisited places have too few shifts for a small p. Among
///         variables that explain equally much to a twentieth, the smallest p wins.
/// Omits   correlation of a slow residual, which tells less about a curve's shape than white noise
///         of as many samples would.
Location Locate(const Channel& channel, std::size_t index, const Series& residual,
                const NoiseModel& noise, const NoiseLevel& level, const Stream& stream,
                int threads = 2, const std::optional<LeadingVariable>& leading = {});

}  // namespace tera
