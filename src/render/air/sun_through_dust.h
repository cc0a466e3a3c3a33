#pragma once

#include <vector>

#include "render/air/dust_volume.h"

namespace tera {

/// Optical depth towards the sun from the centre of each cell with dust, up to the border of the
/// cells; 0 in cells without dust. Steps have the length of a cell. The path omits eddies and
/// treats the ground as level.
std::vector<float> OpticalDepthsToSun(const DustVolume& dust, const Vec3& to_sun_W);

}  // namespace tera
