#pragma once

#include <Eigen/Core>

#include "diagnose/search/fit/replay_block.h"
#include "resimulate/sensor_calibration.h"

namespace tera {

/// Elements of a small change of a calibration: p_BT in B, a rotation vector of T in B's axes in
/// radians, and the three scalar parameters.
enum CalibrationElement {
  kShiftOfMount = 0,
  kTurnOfMount = 3,
  kRangeBias = 6,
  kRangeFactor = 7,
  kClockOffset = 8,
  kCalibrationElements = 9
};
using CalibrationVector = Eigen::Matrix<double, kCalibrationElements, 1>;
using CalibrationMatrix = Eigen::Matrix<double, kCalibrationElements, kCalibrationElements>;
/// One row for each element, one column for each free parameter.
using CalibrationJacobian = Eigen::Matrix<double, kCalibrationElements, Eigen::Dynamic>;

/// Derivatives of the calibration by the terms' free parameters, in their order, by central
/// differences. Each term replaces the scenario's effect of the same mechanism in `present`. `X_BS`
/// is the documented mount.
CalibrationJacobian JacobianOf(const Pose& X_BS, const Effects& present, const Structure& terms);

}  // namespace tera
