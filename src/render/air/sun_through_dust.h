#pragma once

#include <vector>

#include "render/air/dust_volume.h"

namespace tera {

/// Optical depth from the middle of each cell with dust towards the sun, up to the border of the
/// cells, in steps of a cell and without eddies; 0 of cells without dust. The ground is taken as
/// level on the way.
std::vector<float> OpticalDepthsToSun(const DustVolume& dust, const Vec3& to_sun_W);

}  // namespace tera
