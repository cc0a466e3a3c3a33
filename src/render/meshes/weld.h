#pragma once

#include <cstdint>
#include <vector>

#include "core/motion.h"
#include "render/meshes/mesh.h"

namespace tera {

/// Triangles by the places of their corners alone.
struct Welded {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<std::uint32_t> indices;  ///< three for each triangle
};

/// Adds the triangles of a part, in their order; corners of it at the same place, to the bit,
/// become one, and triangles that have no area by that are left out.
void Weld(const MeshPart& part, Welded* welded);

}  // namespace tera
