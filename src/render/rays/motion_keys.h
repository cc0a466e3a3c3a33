#pragma once

#include <cstddef>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Motion keys of one body over a time interval, for linear interpolation. The function refines the
/// given equally spaced poses until a point 4 m from the body's origin deviates less than 0.05 mm
/// from its arc. A stationary body has a single key.
std::vector<Pose> MotionKeys(const std::vector<std::vector<Pose>>& poses, std::size_t body);

}  // namespace tera
