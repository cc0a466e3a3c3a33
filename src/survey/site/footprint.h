#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

struct Footprint {
  Vec2 middle_m = Vec2::Zero();
  double yaw_rad = 0;  ///< angle from the x axis to the longer side, in (-pi/2, pi/2]
  double length_m = 0, width_m = 0;

  /// True if the place lies in the rectangle enlarged by `margin_m` on each side.
  bool Holds(const Vec2& place_m, double margin_m = 0) const;
};

/// Rectangle of least area that contains all places.
///
/// Source  one of its sides lies on the convex hull: Freeman and Shapira 1975, "Determining the
///         minimum-area encasing rectangle for an arbitrary closed curve".
Footprint LeastRectangle(std::vector<Vec2> places_m);

}  // namespace tera
