#include "sim/ground_copies.h"

#include <algorithm>

namespace tera {

std::shared_ptr<const TerrainSurface> GroundCopies::Of(const TerrainSurface& now) {
  const auto free = std::find_if(copies_.begin(), copies_.end(),
                                 [](const auto& copy) { return copy.use_count() == 1; });
  if (free == copies_.end()) return copies_.emplace_back(std::make_shared<TerrainSurface>(now));
  (*free)->Follow(now);
  return *free;
}

}  // namespace tera
