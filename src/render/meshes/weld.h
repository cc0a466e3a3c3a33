#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/motion.h"
#include "render/meshes/mesh.h"

namespace tera {

/// Triangles that share corners by position alone.
struct Welded {
  std::vector<Eigen::Vector3f> positions_m;
  /// Three per triangle; triangles of closed surfaces come first.
  std::vector<std::uint32_t> indices;
  std::size_t closed = 0;  ///< number of indices that belong to closed surfaces
};

/// Welds the triangles of mesh parts.
///
/// Model   corners with bit-identical positions merge. Degenerate triangles are dropped. Triangles
///         that are connected by corners form a surface. A surface is closed if each edge is
///         traversed equally often in both directions and its signed volume is positive (it faces
///         outwards).
///         A ray from outside crosses as many front as back faces of a closed surface. Its first
///         crossing is a front face, unless a part of the surface is inside out. Renderers may
///         therefore cull back faces.
Welded Weld(const std::vector<const MeshPart*>& parts);

}  // namespace tera
