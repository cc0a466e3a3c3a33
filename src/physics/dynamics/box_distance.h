#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Least distance between two boxes in metres; 0 if they overlap. Exact to 1 mm.
///
/// Frames  `X_WA` and `X_WB` are the poses of the bodies that carry the boxes.
/// Source  Gilbert, Johnson, Keerthi 1988, IEEE J. Robotics and Automation 4(2) (Bullet).
double BoxDistance_m(const CollisionBox& a, const Pose& X_WA, const CollisionBox& b,
                     const Pose& X_WB);

}  // namespace tera
