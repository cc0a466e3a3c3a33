#pragma once

#include <cstdint>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Triangles of a site that stay where they are and that machines collide with: walls, buildings.
///
/// Frames  W.
struct SiteWalls {
  std::vector<Vec3> corners_W_m;
  std::vector<std::uint32_t> indices;  ///< three for each triangle

  bool empty() const { return indices.empty(); }
};

}  // namespace tera
