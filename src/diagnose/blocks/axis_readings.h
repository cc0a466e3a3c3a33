#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Nominal numbers of an axis, for initial estimates of its chain.
struct AxisChain {
  std::string axis, pump;  ///< as in YAML; no pump if none feeds the axis alone
  double full_positive_radps = 0, full_negative_radps = 0;
  /// Gain of the axis's own cylinder over its position, 1 at the reference; empty without one.
  std::function<double(double position_rad)> cylinder_gain = {};
  double cylinder_reference_rad = 0;
};

/// Initial estimates of an axis's whole chain from its lever and rate, one for each of several
/// lags, the best first.
///
/// Model   rate = k(q) G m(u(t - d)). G is a first-order lag, k the cylinder's gain or 1. In each
///         direction m is a ramp from a dead band to a saturation. Lags and delays come from a
///         ladder. For each pair, least squares selects the ramps between knots. It needs only the
///         products of a lever's hat functions with themselves and with the rate (static_map.h),
///         and no replay. Load, flow and curve start faint.
/// Omits   ramps of both directions that overlap in time by a lag, except for one correction.
/// Source  Hammerstein models, Narendra and Gallman 1966; the ladder is exhaustive.
std::vector<std::vector<Reading>> ReadAxisChain(const AxisChain& chain, const Channel& channel,
                                                const Mask& seen);

}  // namespace tera
