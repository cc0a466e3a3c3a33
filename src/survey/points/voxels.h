#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Points grouped into the cubes of a regular lattice.
struct Voxels {
  std::vector<int> of_point;  ///< cube of each point; cubes are numbered without gaps
  std::vector<int> count;     ///< number of points in each cube
  std::vector<Vec3> mean_m;   ///< mean point of each cube
};

/// Groups points into cubes with edge `edge_m`. Cubes are numbered by position (z, then y, then x),
/// so the result does not depend on the order of the points.
Voxels GroupByVoxel(const std::vector<Vec3>& p_m, double edge_m);

}  // namespace tera
