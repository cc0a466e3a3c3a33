#pragma once

#include <cstddef>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Poses of one body over an interval of time, for straight lines between them: those given at
/// equally spaced times, refined until a turn between neighbours moves what is 4 m from the body's
/// origin less than 0.05 mm off its arc. One where the body stands still.
std::vector<Pose> MotionKeys(const std::vector<std::vector<Pose>>& poses, std::size_t body);

}  // namespace tera
