#pragma once

#include <optional>

#include "core/motion.h"
#include "soil/columns/columns.h"

namespace tera {

/// The shortest path out of the ground from a point in it.
///
/// Frames  W.
/// Model   The surface consists of triangles between columns; the diagonal of a cell runs from (i,
///         j) to (i+1, j+1). The path leads to the nearest point of this surface. Its length
///         changes continuously with the point. It leads horizontally out of a pit wall and along
///         the normal of a slope.
/// Omits   Paths longer than `kReach_m` that do not go straight up.
struct GroundExit {
  static constexpr double kReach_m = 0.5;

  double depth_m;    ///< length of the way
  Vec3 direction_W;  ///< unit vector out of the ground
};

/// The path out from `p_W_m`; empty if the point is above the ground.
std::optional<GroundExit> FindGroundExit(const Columns& ground, const Vec3& p_W_m);

}  // namespace tera
