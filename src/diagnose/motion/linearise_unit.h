#pragma once

#include "diagnose/motion/motion_at.h"

namespace tera {

/// Fills the output with an inertial unit's residuals and derivatives (SegmentLinearisation).
void LineariseUnit(const UnitChannel& unit, const MotionAt& at);

/// Measurement of an ideal unit in its true frame: rates, then forces.
Eigen::Matrix<double, 6, 1> IdealOf(const UnitChannel& unit, const MotionAt& at,
                                    const Numbers& numbers);

}  // namespace tera
