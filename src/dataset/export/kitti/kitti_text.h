#pragma once

#include <string>

#include "core/motion.h"
#include "core/time.h"
#include "dataset/format/sensor_sheet.h"

/// Numbers in KITTI's text format: separated by blanks, matrices row by row.

namespace tera {

std::string NumbersText(const Eigen::Ref<const Eigen::MatrixXd>& matrix);
/// The upper three rows of a pose.
std::string PoseText(const Pose& pose);

/// 3 x 4: from rectified camera coordinates in m to pixels, times depth.
Eigen::Matrix<double, 3, 4> ProjectionOf(const CameraLens& lens);

/// "2011-09-26 13:02:25.964389445".
std::string DateAndTimeText(TimeNs unix_ns);
/// "09-Jan-2012 13:57:47".
std::string CalibrationTimeText(TimeNs unix_ns);
/// "2011_09_26".
std::string DayText(TimeNs unix_ns);

}  // namespace tera
