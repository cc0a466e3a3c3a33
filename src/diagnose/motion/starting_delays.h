#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/motion/motion_estimate.h"

namespace tera {

/// An axis of an inertial unit with a sign opposite to the motion.
struct OpposedAxis {
  std::size_t unit = 0;
  int row = 0;   ///< turn rates 0-2, specific forces 3-5
  double p = 1;  ///< p-value of the opposition, corrected for the number of tries
};

/// Axes of inertial units whose measurement opposes the motion. Each triad is tested by itself.
///
/// Model   delays within 0.5 s of the unit's own delay are tried. At the delay with the largest
///         magnitude of the uncentred correlation, an axis is opposed where this correlation is
///         below -0.7 and OppositionP below 0.01. The p-value is corrected for all tried delays and
///         axes. A unit whose same two axes oppose in both triads is rotated by half a turn and is
///         not reported.
/// Omits   axes that the motion hardly excites, such as the axis across a link that does not shake.
std::vector<OpposedAxis> OpposedAxes(const MotionProblem& problem, const MotionEstimate& motion);

/// Sets a starting delay for each inertial unit. Under repeated turning to and fro, other delays
/// fit nearly as well. An estimate that starts far from the true delay can end there with too much
/// noise.
///
/// Model   delays within 0.5 s of the documented one are tried. The one with the smallest mean
///         square difference between the unit's turn rates and those of the starting motion is
///         taken. The documented delay stays unless another one halves this mean square.
/// Omits   a delay of the starting motion itself; channels other than inertial units.
/// Source  Furgale, Rehder and Siegwart 2013, "Unified temporal and spatial calibration for
///         multi-sensor systems", on a start by correlation of rates.
void SetStartingDelays(const MotionProblem& problem, MotionEstimate* start);

}  // namespace tera
