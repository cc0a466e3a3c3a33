#pragma once

#include <Eigen/Core>

#include "diagnose/search/fit/replay_block.h"
#include "resimulate/sensor_calibration.h"

namespace tera {

/// Elements of a small change of a calibration: p_BT in B, a rotation vector of T about the axes of
/// B in radians, and the three numbers.
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
/// One row an element, one column a free parameter.
using CalibrationJacobian = Eigen::Matrix<double, kCalibrationElements, Eigen::Dynamic>;

/// Derivatives of the calibration under `terms`, each in place of what is `present` of its
/// mechanism, by the free parameters of the terms in their order: central differences. `X_BS` is
/// the documented mount.
CalibrationJacobian JacobianOf(const Pose& X_BS, const Effects& present, const Structure& terms);

}  // namespace tera
