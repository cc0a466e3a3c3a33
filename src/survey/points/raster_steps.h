#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Removes the points of a raster that are next to a step: one of the eight neighbours differs in
/// height by more than a pixel. A step is a wall, whose exact place a raster does not show.
std::vector<Vec3> WithoutSteps(const std::vector<Vec3>& p_m, const Vec2& pixel_m);

}  // namespace tera
