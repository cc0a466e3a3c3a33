#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/motion/motion_estimate.h"

namespace tera {

/// An axis of an inertial unit that measures the opposite of what a motion implies.
struct OpposedAxis {
  std::size_t unit = 0;
  int row = 0;   ///< of its rates, then forces
  double p = 1;  ///< of going so steadily against the motion by chance
};

/// The axes that go against a motion, each of either triad by itself.
///
/// Model   of delays up to half a second about the unit's own the one at which an axis correlates
///         most with what the motion implies, about zero; opposed where that is below -0.7 and
///         OppositionP, over as many tries as there are delays and axes, below 0.01. Two axes of
///         both triads alike are no reversed ones but a unit turned by half a turn.
/// Omits   axes of which the motion tells little, as across a link that nothing shakes.
std::vector<OpposedAxis> OpposedAxes(const MotionProblem& problem, const MotionEstimate& motion);

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
