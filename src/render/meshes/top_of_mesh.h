#pragma once

#include <vector>

#include "render/meshes/mesh.h"

namespace tera {

/// A mesh from above, on a grid: how high it reaches, and its colour there.
///
/// Frames  of the mesh, z up; vertex (i, j) lies over low_m + cell_m (i, j).
/// Model   the highest triangle on the vertical line through each vertex, edges included; colour is
///         the material's, its vertices' and its base colour texture's at that point.
struct TopOfMesh {
  Vec2 low_m = Vec2::Zero();
  double cell_m = 1;
  int nx = 0, ny = 0;
  std::vector<float> height_m;          ///< row-major, x fastest; NaN where nothing lies
  std::vector<Eigen::Vector3f> albedo;  ///< linear, one for each height

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * nx + i; }
};

/// The top of `mesh` on nx x ny vertices from `low_m` on, `cell_m` apart.
TopOfMesh TopOf(const Mesh& mesh, const Vec2& low_m, double cell_m, int nx, int ny);

}  // namespace tera
