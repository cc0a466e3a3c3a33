#pragma once

#include <cstdint>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Static triangles of a site with which machines collide: walls, buildings.
///
/// Frames  W.
struct SiteWalls {
  std::vector<Vec3> corners_W_m;
  std::vector<std::uint32_t> indices;  ///< three per triangle

  bool empty() const { return indices.empty(); }
};

}  // namespace tera
