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
  double p = 1;           ///< by Holm over the variables; unadjusted where shifts are too few
  double share = 0;       ///< of the whitened residual's energy that it explains
  CurveShape shape;
  RegimeCurve curve;
};

/// The place of a channel's error, in time and among the channel's variables.
struct Location {
  std::size_t channel = 0;
  std::vector<Segment> intervals;  ///< in samples
  std::size_t worst = 0;           ///< index of the interval with the most error beyond noise
  std::vector<Regime> regimes;     ///< the best regressor first; each given those before it
};

/// Locates the residual of a channel in time and among the channel's variables.
///
/// Model   In time (change_points.h), at one per cent: where innovations differ from noise, and
///         where the residual's own level does. The latter is over the noise's deviation, of a
///         sample or of long means, whichever is larger, but at most three times the noise at rest,
///         or ten times what differences between samples say of it. By variable (partialling.h,
///         regime_curve.h): the error as a function of each variable, and as the simulated value
///         times such a function, tested against the noise. For a residual of three times the noise
///         (ten times in a recording without rest) the test is against white noise of the
///         residual's size. A variable that explains 1.3 times as much as the best significant one,
///         or two per cent where none is significant, comes first with its unadjusted p: time, and
///         places that are seldom revisited, have too few shifts for a small p. Of several that
///         explain as much to a twentieth it is the one of the smallest p.
/// Omits   that under white noise a slow residual says less about a curve's shape than its number
///         of samples suggests.
Location Locate(const Channel& channel, std::size_t index, const Series& residual,
                const NoiseModel& noise, const NoiseLevel& level, const Stream& stream,
                int threads = 2);

}  // namespace tera
