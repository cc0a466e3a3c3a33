#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/motion/motion_estimate.h"

namespace tera {

/// An axis of an inertial unit that measures the opposite of the motion.
struct OpposedAxis {
  std::size_t unit = 0;
  int row = 0;   ///< of its rates, then forces
  double p = 1;  ///< of going so steadily against the motion by chance
};

/// The axes that go against a motion, each of either triad by itself.
///
/// Model   among delays up to half a second about the unit's own, the one at which an axis
///         correlates most with the motion, about zero. The axis is opposed where that correlation
///         is below -0.7 and AntiCorrelationPValue below 0.01, over as many tries as there are
///         delays and axes. Two axes of both triads alike are no reversed ones but a unit turned by
///         half a turn.
/// Omits   axes that the motion hardly excites, as across a link that nothing shakes.
std::vector<OpposedAxis> OpposedAxes(const MotionProblem& problem, const MotionEstimate& motion);

/// Sets the delay of each inertial unit near enough for an estimate to find it. From afar, turning
/// to and fro makes other delays fit nearly as well, and the unit seems noisy instead.
///
/// Model   among delays up to half a second about the documented one, the one with the least mean
///         square of the unit's rates minus the starting motion's. The documented one remains where
///         no other halves that.
/// Omits   that the starting motion is late itself; channels other than inertial units.
/// Source  Furgale, Rehder and Siegwart 2013, "Unified temporal and spatial calibration for
///         multi-sensor systems", on beginning with a correlation of rates.
void SetStartingDelays(const MotionProblem& problem, MotionEstimate* start);

}  // namespace tera
