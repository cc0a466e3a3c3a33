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

/// A variable that a channel's error is a function of, and the function's shape.
struct Regime {
  std::string variable;
  bool is_share = false;  ///< the curve is of the error over the simulated value
  double p = 1;           ///< Holm over the variables; as it is where shifts are too few (Locate)
  double share = 0;       ///< of the whitened residual's energy that it explains
  CurveShape shape;
  RegimeCurve curve;
};

/// Where a channel's error is.
struct Location {
  std::size_t channel = 0;
  std::vector<Segment> intervals;  ///< in samples
  std::size_t worst = 0;           ///< of the intervals: that with the most error beyond noise
  std::vector<Regime> regimes;     ///< the best regressor first; each given those before it
};

/// Locates the residual of a channel in time and among the channel's variables.
///
/// Model   in time (change_points.h): where innovations are not noise, and where the residual is
///         not by itself, over the noise's deviation of a sample or of long means, whichever is
///         larger, at most three times the noise at rest, or ten times what differences between
///         samples say of it; one per cent for both. By variable (partialling.h, regime_curve.h):
///         each as it is, and as what a share of the simulated value depends on,
///         beside the noise or, for a residual of three times the noise (ten times in a recording
///         without rest), beside white noise of the residual's size. A variable that explains 1.3
///         times as much as the best significant one, or two per cent where none is
///         significant, comes first with its p as it is: time, and a place that is seldom come back
///         to, have too few shifts for a small one; of several that explain as much to a twentieth
///         it is the one of the smallest p.
/// Omits   under white noise, that a slow residual says less about a curve's shape than its samples
///         are many.
Location Locate(const Channel& channel, std::size_t index, const Series& residual,
                const NoiseModel& noise, const NoiseLevel& level, const Stream& stream,
                int threads = 2);

}  // namespace tera
