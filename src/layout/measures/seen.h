#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/sight/look.h"
#include "layout/study/study.h"

namespace tera {

/// View of each viewer, at its current pose, on each place in the air: [place][viewer]. `seen`
/// gives the required density of samples.
std::vector<std::vector<Look>> LookAt(const std::vector<Vec3>& places_W_m, const Layout& layout,
                                      const SeenFrom& seen, const Sighting& sighting);

/// Number of viewers that see a place.
int SeenBy(const std::vector<Look>& looks);

}  // namespace tera
