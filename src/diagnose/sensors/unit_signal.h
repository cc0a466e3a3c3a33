#pragma once

#include "diagnose/sensors/sensor_problem.h"

/// Low passes and ranges of inertial units. Near documented numbers they change nothing, or what a
/// delay changes. An estimate has to begin from a unit that has one.

namespace tera {

/// The name of the sensor of a problem's inertial unit.
const std::string& UnitOf(const SensorProblem& problem, std::size_t unit);

/// The sum of logarithms of the scales of all residuals: the likelihood's, but for what is the same
/// of all estimates.
double LogScale(const MotionEstimate& estimate);

/// The estimate with a low pass in each unit that is late, where that explains more than a delay
/// does and its time constant is beyond tolerance. Near documented numbers both look the same.
MotionEstimate WithLowPasses(const DiagnosisInput& input, const EstimateOptions& options,
                             MotionEstimate best, SensorProblem* problem);

/// The estimate with a range of each gyro and accelerometer that the motion exceeds, where that
/// explains more.
///
/// Model   a triad's limit is the median of its measurements where the motion is beyond all of
///         them. It is tried where it makes the recording twenty times as likely.
///         A documented range holds in its place, and is not named.
/// Omits   limits of single axes or directions; ranges that the motion hardly exceeds; spikes
///         beyond a range, which hide it.
MotionEstimate WithClipping(const DiagnosisInput& input, const EstimateOptions& options,
                            MotionEstimate best, SensorProblem* problem);

}  // namespace tera
