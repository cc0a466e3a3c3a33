#pragma once

#include "diagnose/motion/motion_estimate.h"

namespace tera {

/// Sets the delay of each inertial unit near enough for an estimate to find it: from afar, turning
/// to and fro makes other delays fit nearly as well, and the unit seems noisy instead.
///
/// Model   of delays up to half a second about the documented one, that with which the unit's rates
///         differ least, in mean square, from those of the motion that the estimate begins with;
///         the documented one where no other halves that.
/// Omits   that the starting motion is late itself; channels other than inertial units.
/// Source  Furgale, Rehder and Siegwart 2013, "Unified temporal and spatial calibration for
///         multi-sensor systems", on beginning with a correlation of rates.
void SetStartingDelays(const MotionProblem& problem, MotionEstimate* start);

}  // namespace tera
