#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Nominal numbers of one axis, for initial estimates of its actuation chain.
struct AxisChain {
  std::string axis, pump;  ///< names as in YAML; `pump` is empty without a candidate of its flow
  double full_positive_radps = 0, full_negative_radps = 0;
  /// Gain of the axis's cylinder over position, 1 at the reference. Empty without a cylinder.
  std::function<double(double position_rad)> cylinder_gain = {};
  double cylinder_reference_rad = 0;
};

/// Initial estimates of the chain from lever to rate. Returns at most three estimates with
/// different lags, the best first.
///
/// Model   rate = k(q) G m(u(t - d)). G is a first-order lag, d the delay, and k the cylinder's
///         gain or 1. In each direction, m is a ramp from a dead band to a saturation. Lags and
///         delays are taken from fixed lists. For each pair, least squares selects the ramps
///         between knots. The least-squares fit needs only products of the lever's hat functions
///         with themselves and with the rate (static_map.h), and no replay. Parameters that the
///         ramps do not determine start with faint effects.
/// Omits   Ramps of both directions that overlap within a lag, except for one correction.
/// Source  Hammerstein models: Narendra and Gallman 1966. The lists are searched exhaustively.
std::vector<std::vector<Reading>> ReadAxisChain(const AxisChain& chain, const Channel& channel,
                                                const Mask& seen);

}  // namespace tera
