#pragma once

#include "diagnose/motion/motion_at.h"

namespace tera {

/// Fills `at.out` with the residuals and derivatives of an inertial unit (SegmentLinearisation).
void LineariseUnit(const UnitChannel& unit, const MotionAt& at);

/// Measurement of an ideal unit in its true frame: turn rates, then specific forces.
Eigen::Matrix<double, 6, 1> IdealOf(const UnitChannel& unit, const MotionAt& at,
                                    const Numbers& numbers);

}  // namespace tera
