#pragma once

#include <vector>

#include "render/meshes/mesh.h"

namespace tera {

/// Top view of a mesh on a grid: height and colour.
///
/// Frames  mesh frame, z up; vertex (i, j) lies over low_m + cell_m (i, j).
/// Model   the highest triangle on the vertical line through each vertex, edges included. The
///         colour combines the material, its vertex colours and its base colour texture at that
///         point.
struct TopOfMesh {
  Vec2 low_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0;
  std::vector<float> height_m;          ///< row-major, x fastest; NaN without a surface
  std::vector<Eigen::Vector3f> albedo;  ///< linear, one per height

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * nx + i; }
};

/// Top of `mesh` on nx x ny vertices from `low_m`, spaced by `cell_m`.
TopOfMesh TopOf(const Mesh& mesh, const Vec2& low_m, double cell_m, int nx, int ny);

}  // namespace tera
