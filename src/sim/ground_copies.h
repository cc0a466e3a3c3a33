#pragma once

#include <memory>
#include <vector>

#include "core/types/terrain_surface.h"

namespace tera {

/// Copies of one ground that changes, each as it was when it was asked for.
///
/// Model   a copy that nobody holds any more is brought up to date for the next one, so that what
///         is copied are the tiles that have changed since.
class GroundCopies {
 public:
  /// The ground as it is now. To be let go by the thread that asked for it.
  std::shared_ptr<const TerrainSurface> Of(const TerrainSurface& now);

 private:
  std::vector<std::shared_ptr<TerrainSurface>> copies_;
};

}  // namespace tera
