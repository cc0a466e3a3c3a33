#pragma once

#include <string>

#include "core/motion.h"
#include "core/time.h"
#include "dataset/format/sensor_sheet.h"

/// Numbers separated by blanks; a matrix is written row by row.

namespace tera {

std::string NumbersText(const Eigen::Ref<const Eigen::MatrixXd>& matrix);
/// The upper three rows of the 4x4 matrix.
std::string PoseText(const Pose& pose);

/// The 3x4 projection P: depth * (u, v, 1) = P (x, y, z, 1), from rectified camera coordinates in m
/// to pixels.
Eigen::Matrix<double, 3, 4> ProjectionOf(const CameraLens& lens);

/// Format "2011-09-26 13:02:25.964389445".
std::string DateAndTimeText(TimeNs unix_ns);
/// Format "09-Jan-2012 13:57:47".
std::string CalibrationTimeText(TimeNs unix_ns);
/// Format "2011_09_26".
std::string DayText(TimeNs unix_ns);

}  // namespace tera
