#pragma once

#include <vector>

#include "render/meshes/mesh.h"

namespace tera {

/// A mesh seen from above, as height and colour on a grid.
///
/// Frames  mesh frame, z up. Vertex (i, j) lies at low_m + cell_m (i, j).
/// Model   the highest triangle on the vertical line through each vertex; triangles include their
///         edges. The colour combines material, vertex colours and base colour texture at that
///         point.
struct TopOfMesh {
  Vec2 low_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0;
  std::vector<float> height_m;          ///< row-major, x fastest; NaN if no triangle is there
  std::vector<Eigen::Vector3f> albedo;  ///< linear, one per height

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * nx + i; }
};

/// View of `mesh` from above on nx x ny vertices, spaced by `cell_m` from `low_m`.
TopOfMesh TopOf(const Mesh& mesh, const Vec2& low_m, double cell_m, int nx, int ny);

}  // namespace tera
