#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Points by the cubes of a lattice that they lie in.
struct Voxels {
  std::vector<int> of_point;  ///< number of each point's cube; cubes are numbered without gap
  std::vector<int> count;     ///< points in each cube
  std::vector<Vec3> mean_m;   ///< of each cube's points
};

/// Cubes of `edge_m`, in the order of their places (z, then y, then x), so that equal points give
/// equal numbers whatever their order.
Voxels GroupByVoxel(const std::vector<Vec3>& p_m, double edge_m);

}  // namespace tera
