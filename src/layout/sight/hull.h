#pragma once

#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// Distance from H to the outermost point of a machine in each of `sectors` directions,
/// counterclockwise from the x axis of H. Counts undercarriage, tracks, blade and upper structure
/// up to the height of a person, but not boom, arm and bucket.
///
/// Frames  H stands upright on the ground.
std::vector<double> HullRadii_m(const Pose& X_WH, std::size_t machine, int sectors,
                                const Sighting& sighting);

}  // namespace tera
