#pragma once

#include "core/types/effects.h"

namespace tera {

/// The static curve of a valve. The defaults are the identity on -1..+1.
struct LeverMapParameters {
  double limit_positive = 1, limit_negative = 1;  ///< limits of |u|
  double dead_positive = 0, dead_negative = 0;
  double exponent = 1;
  double positive_gain = 1, negative_gain = 1;
};

LeverMapParameters LeverMapOf(const Effects& effects);

/// Slot `lever_map`: share of the full rate that the valve demands at lever `u`.
///
/// Model   The mechanisms act in this order:
///         - lever_saturation: |u| is at most the limit of its direction.
///         - dead_band: y = u - d sgn u beyond d, and 0 within it. The full lever then gives 1 - d.
///         - valve_curve: |y|^n sgn y.
///         - asymmetric_gain and rate_gain: a factor for each direction.
/// Omits   Hysteresis of the spool, dependence of the curve on pressure.
double MapLever(const LeverMapParameters& parameters, double u);

}  // namespace tera
