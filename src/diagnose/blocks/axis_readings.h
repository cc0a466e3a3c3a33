#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The nominal numbers of an axis with which its chain is read off a recording.
struct AxisChain {
  std::string axis, pump;  ///< as in YAML; no pump: none feeds it alone
  double full_positive_radps = 0, full_negative_radps = 0;
  /// The gain of the axis's own cylinder over its position, 1 at the reference; empty without one.
  std::function<double(double position_rad)> cylinder_gain = {};
  double cylinder_reference_rad = 0;
};

/// The chain of an axis in full, as an engineer reads it off its lever and rate, once for each of
/// several lags, the best first: where a fit begins.
///
/// Model   rate = k(q) G m(u(t - d)), G a lag of first order, k the cylinder's gain or 1, m in each
///         direction a ramp from a dead band to a saturation. Lags and delays are those of a
///         ladder; of each pair the ramps between knots that leave least in the sense of least
///         squares follow from the products of a lever's hat functions with themselves and with the
///         rate (static_map.h), without a replay. Load, flow and curve begin faint.
/// Omits   ramps of both directions that overlap in time by a lag, but for one correction.
/// Source  Hammerstein models, Narendra and Gallman 1966; the ladder is exhaustive.
std::vector<std::vector<Reading>> ReadAxisChain(const AxisChain& chain, const Channel& channel,
                                                const Mask& seen);

}  // namespace tera
