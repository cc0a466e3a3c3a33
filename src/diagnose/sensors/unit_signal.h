#pragma once

#include "diagnose/sensors/sensor_problem.h"

/// Low passes and limited ranges of inertial units. Linearised at the documented values, a range
/// has no effect and a low pass has the effect of a delay. An estimate must therefore start from a
/// unit that has one.

namespace tera {

/// Sensor name of a problem's inertial unit.
const std::string& UnitOf(const SensorProblem& problem, std::size_t unit);

/// Sum over all residuals of the logarithm of their noise scale: the negative log-likelihood up to
/// a constant.
double LogScale(const MotionEstimate& estimate);

/// Tries a low pass in each unit whose delay exceeds its tolerance. The low pass is kept if it
/// explains more than the delay and its time constant is beyond tolerance.
MotionEstimate WithLowPasses(const DiagnosisInput& input, const EstimateOptions& options,
                             MotionEstimate best, SensorProblem* problem);

/// Tries a limited range in each gyro and accelerometer whose range the motion exceeds. The limit
/// is kept if it explains more.
///
/// Model   the limit of a triad is the median of its measurements at times when the motion exceeds
///         the largest measurement. It is tried where the recording becomes twenty times as likely.
///         A documented range replaces it, and is not named.
/// Omits   limits of single axes or directions; ranges that the motion hardly exceeds; ranges
///         hidden by a spike beyond them.
MotionEstimate WithClipping(const DiagnosisInput& input, const EstimateOptions& options,
                            MotionEstimate best, SensorProblem* problem);

}  // namespace tera
