#pragma once

#include <optional>

#include "core/motion.h"
#include "soil/columns/columns.h"

namespace tera {

/// The shortest way out of the ground from a point in it.
///
/// Frames  W.
/// Model   The surface is a sheet of triangles between the columns, each cell cut along its
///         diagonal from (i, j) to (i+1, j+1). The way leads to the nearest point of the sheet. So
///         it leads out of the wall beside a pit, and along the normal on a slope, and its length
///         is continuous.
/// Omits   ways longer than `kReach_m` that are not straight up.
struct GroundExit {
  static constexpr double kReach_m = 0.5;

  double depth_m;    ///< length of the way
  Vec3 direction_W;  ///< unit, out of the ground
};

/// The way out from `p_W_m`, if it is in the ground.
std::optional<GroundExit> FindGroundExit(const Columns& ground, const Vec3& p_W_m);

}  // namespace tera
