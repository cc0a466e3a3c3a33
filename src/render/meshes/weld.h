#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/motion.h"
#include "render/meshes/mesh.h"

namespace tera {

/// Triangles defined by corner positions alone.
struct Welded {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<std::uint32_t> indices;  ///< three per triangle; closed surfaces first
  std::size_t closed = 0;              ///< number of indices that belong to closed surfaces
};

/// Welds the triangles of mesh parts.
///
/// Model   corners at bit-identical positions merge; degenerate triangles are dropped. A surface is
///         a set of triangles connected by corners. It is closed if opposite traversals of each
///         edge balance and its signed volume is positive: it faces outwards on the whole. A ray
///         from outside then crosses equally many of its front and back faces. The first is a front
///         face if no part of the surface is turned inside out.
Welded Weld(const std::vector<const MeshPart*>& parts);

}  // namespace tera
