#pragma once

#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// Reach of a machine in each of `sectors` directions around H, counterclockwise from its x axis.
/// It extends to the outermost point of undercarriage, tracks, blade and upper structure up to the
/// height of a person. Boom, arm and bucket do not count.
///
/// Frames  H stands upright on the ground.
std::vector<double> HullRadii_m(const Pose& X_WH, std::size_t machine, int sectors,
                                const Sighting& sighting);

}  // namespace tera
