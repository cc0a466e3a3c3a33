#pragma once

#include <cstddef>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Motion keys of a body over a time interval, for linear interpolation between them. `poses` has
/// equally spaced times, each with a pose per body. Keys are added until a point 4 m from the
/// body's origin is within 0.05 mm of its arc. A body at rest has a single key.
std::vector<Pose> MotionKeys(const std::vector<std::vector<Pose>>& poses, std::size_t body);

}  // namespace tera
