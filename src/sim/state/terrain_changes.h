#pragma once

#include <cstdint>
#include <vector>

#include "core/types/terrain_surface.h"

namespace tera {

/// What one step did to the visible ground.
///
/// Frames  W.
struct TerrainChange {
  struct At {
    int i = 0, j = 0;
    TerrainSurface::Vertex vertex;  ///< as it is from now on
  };
  std::vector<int> refined_tiles;  ///< whose vertices have places of their own from now on
  std::vector<At> vertices;        ///< tile by tile, row by row in each
  std::vector<TerrainSurface::Grain> grains;  ///< all that move now
};

/// Brings `ground` to where the change leads. Gives every tile that changes another version.
void Apply(const TerrainChange& change, TerrainSurface* ground);

/// Finds what changes of a ground from step to step.
class TerrainTracker {
 public:
  /// `ground` as its reader knows it already.
  explicit TerrainTracker(const TerrainSurface& ground);

  /// The differences of `now` from the ground as it is known.
  TerrainChange Find(const TerrainSurface& now);
  /// From now on the ground is known as the change leaves it.
  void Accept(const TerrainChange& change) { Apply(change, &known_); }
  const TerrainSurface& known() const { return known_; }

 private:
  void CompareTile(const TerrainSurface& now, int a, int b, TerrainChange* change) const;

  TerrainSurface known_;
  std::vector<std::uint32_t> version_;  ///< of each tile of the other when it was last compared
};

}  // namespace tera
