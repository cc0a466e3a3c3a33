#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/motion.h"
#include "render/meshes/mesh.h"

namespace tera {

/// Triangles by the places of their corners alone.
struct Welded {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<std::uint32_t> indices;  ///< three for each triangle, closed surfaces first
  std::size_t closed = 0;              ///< of the indices: those of closed surfaces
};

/// The triangles of some parts of a mesh.
///
/// Model   corners at the same place, to the bit, are one; triangles that have no area by that are
///         left out. A surface is what hangs together by corners; it is closed if each of its edges
///         is passed as often one way as the other and it faces outwards. On any ray from outside
///         it has as many triangles that face the ray's start as others, and the first faces it.
Welded Weld(const std::vector<const MeshPart*>& parts);

}  // namespace tera
