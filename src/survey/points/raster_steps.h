#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Drops a raster's points at steps: points with one of eight neighbours higher or lower by more
/// than a pixel. A wall stands there, and a raster knows neither its place nor its side.
std::vector<Vec3> WithoutSteps(const std::vector<Vec3>& p_m, const Vec2& pixel_m);

}  // namespace tera
