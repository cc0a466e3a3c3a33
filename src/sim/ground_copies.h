#pragma once

#include <memory>
#include <vector>

#include "core/types/terrain_surface.h"

namespace tera {

/// Copies of a changing ground, each at the time of its request.
///
/// Model   a copy without holders is updated for the next request, so only the changed tiles are
///         copied.
class GroundCopies {
 public:
  /// A copy of the current ground. The thread that requested it must release it.
  std::shared_ptr<const TerrainSurface> Of(const TerrainSurface& now);

 private:
  std::vector<std::shared_ptr<TerrainSurface>> copies_;
};

}  // namespace tera
