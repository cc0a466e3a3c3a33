#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Points grouped by the cubes of a lattice.
struct Voxels {
  std::vector<int> of_point;  ///< cube of each point; cubes are numbered without gaps
  std::vector<int> count;     ///< points in each cube
  std::vector<Vec3> mean_m;   ///< mean of each cube's points
};

/// Groups points into cubes of `edge_m`. Cubes are numbered by position (z, then y, then x), so the
/// order of the points has no effect.
Voxels GroupByVoxel(const std::vector<Vec3>& p_m, double edge_m);

}  // namespace tera
