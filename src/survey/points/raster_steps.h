#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// A raster's points without those beside a step: where one of the eight pixels around is higher or
/// lower by more than a pixel. There a wall stands, of which a raster knows neither place nor side.
std::vector<Vec3> WithoutSteps(const std::vector<Vec3>& p_m, const Vec2& pixel_m);

}  // namespace tera
