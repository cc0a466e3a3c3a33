#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/sight/sighting.h"
#include "layout/study/study.h"

namespace tera {

/// Why a viewer does not see a place.
enum class Unseen { kOutOfView, kTooFarOrSparse, kBlocked };

/// A viewer and a place.
struct Look {
  bool sees = false;
  Unseen why = Unseen::kOutOfView;  ///< where it does not
  Blocked by;                       ///< where something is in the way
};

/// Looks at each place from each viewer of a layout, which stand where they are now:
/// [place][viewer]. A place counts as seen by a viewer that has it in view and in reach, at the
/// density that `seen` asks, with nothing in the way.
std::vector<std::vector<Look>> LookAt(const std::vector<Vec3>& places_W_m, const Layout& layout,
                                      const SeenFrom& seen, const Sighting& sighting);

/// How many of the viewers see a place.
int SeenBy(const std::vector<Look>& looks);

}  // namespace tera
