#pragma once

#include <memory>
#include <vector>

#include "core/types/terrain_surface.h"

namespace tera {

/// Snapshots of a changing ground.
///
/// Model   a snapshot that nobody holds any more is reused for the next request, which copies only
///         the tiles that have changed since.
class GroundCopies {
 public:
  /// A snapshot of the current ground. It must be released by the thread that requested it.
  std::shared_ptr<const TerrainSurface> Of(const TerrainSurface& now);

 private:
  std::vector<std::shared_ptr<TerrainSurface>> copies_;
};

}  // namespace tera
