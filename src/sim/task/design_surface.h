#pragma once

#include <optional>
#include <vector>

#include "core/motion.h"
#include "core/units.h"

namespace tera {

/// The designed shape of the ground: a plane floor over a polygon, and sides that rise from its
/// edges.
///
/// Frames  W.
/// Model   floor: z = floor_m + grade . (xy - at). Outside the floor, at the distance d from it: z
///         of the nearest point of the floor's edge plus d tan(side slope). Vertical sides have no
///         width.
/// Omits   floors of several planes, curved lines, sides of different slopes.
struct DesignSurface {
  std::vector<Vec2> corners_W_m;  ///< of the floor; the polygon must not cross itself
  Vec2 at_W_m = Vec2::Zero();
  double floor_m = 0;           ///< z of the floor at `at_W_m`
  Vec2 grade = Vec2::Zero();    ///< rise of the floor along x and y
  double side_rad = 0.5 * kPi;  ///< slope angle of the sides from the horizontal

  /// Design height at a place. Empty outside vertical sides.
  std::optional<double> HeightAt(const Vec2& xy_W_m) const;
  /// Distance from the floor's edge, positive on the floor, negative outside.
  double InsideBy_m(const Vec2& xy_W_m) const;
  double FloorAt(const Vec2& xy_W_m) const { return floor_m + grade.dot(xy_W_m - at_W_m); }
};

}  // namespace tera
