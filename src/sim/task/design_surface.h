#pragma once

#include <optional>
#include <vector>

#include "core/motion.h"
#include "core/units.h"

namespace tera {

/// The ground as it shall be dug: a plane floor over a polygon, and sides that rise from its edges.
///
/// Frames  W.
/// Model   floor z = floor_m + grade . (xy - at). At distance d beyond the floor, z is that of the
///         nearest point of the edge plus d tan(side slope). Upright sides have no width.
/// Omits   floors of several planes, curved lines, sides of unlike slopes.
struct DesignSurface {
  std::vector<Vec2> corners_W_m;  ///< of the floor; the polygon does not cross itself
  Vec2 at_W_m = Vec2::Zero();
  double floor_m = 0;           ///< z of the floor at `at_W_m`
  Vec2 grade = Vec2::Zero();    ///< rise of the floor along x and y
  double side_rad = 0.5 * kPi;  ///< slope of the sides, from level

  /// z at a place; nothing beyond upright sides.
  std::optional<double> HeightAt(const Vec2& xy_W_m) const;
  /// Distance from the floor's edge, positive on the floor.
  double InsideBy_m(const Vec2& xy_W_m) const;
  double FloorAt(const Vec2& xy_W_m) const { return floor_m + grade.dot(xy_W_m - at_W_m); }
};

}  // namespace tera
