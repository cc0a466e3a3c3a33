#pragma once

#include <vector>

#include "render/air/dust_volume.h"

namespace tera {

/// Optical depth from the centre of each dusty cell towards the sun, up to the border of the grid;
/// 0 in cells without dust. Ray marching uses steps of one cell. It omits the eddies and treats the
/// ground as level.
std::vector<float> OpticalDepthsToSun(const DustVolume& dust, const Vec3& to_sun_W);

}  // namespace tera
