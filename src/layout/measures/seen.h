#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/sight/look.h"
#include "layout/study/study.h"

namespace tera {

/// Looks at each place in the air from each viewer of a layout, which stand where they are now, for
/// as many samples as `seen` asks: [place][viewer].
std::vector<std::vector<Look>> LookAt(const std::vector<Vec3>& places_W_m, const Layout& layout,
                                      const SeenFrom& seen, const Sighting& sighting);

/// How many of the viewers see a place.
int SeenBy(const std::vector<Look>& looks);

}  // namespace tera
