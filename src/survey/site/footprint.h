#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// A rectangle on the ground.
struct Footprint {
  Vec2 middle_m = Vec2::Zero();
  double yaw_rad = 0;  ///< direction of the longer side from x, in (-pi/2, pi/2]
  double length_m = 0, width_m = 0;

  /// Whether a place lies in the rectangle, widened by `margin_m`.
  bool Holds(const Vec2& place_m, double margin_m = 0) const;
};

/// The rectangle of least area that holds all places.
///
/// Source  one of its sides lies along the convex hull: Freeman and Shapira 1975, "Determining the
///         minimum-area encasing rectangle for an arbitrary closed curve".
Footprint LeastRectangle(std::vector<Vec2> places_m);

}  // namespace tera
