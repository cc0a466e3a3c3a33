#pragma once

#include <cstdint>
#include <vector>

#include "core/types/terrain_surface.h"

namespace tera {

/// Change of the visible ground in one step.
///
/// Frames  W.
struct TerrainChange {
  struct At {
    int i = 0, j = 0;
    TerrainSurface::Vertex vertex;  ///< new value
  };
  /// Tiles that change from the coarse initial grid to their own vertices.
  std::vector<int> refined_tiles;
  std::vector<At> vertices;                   ///< by tile, then by row
  std::vector<TerrainSurface::Grain> grains;  ///< all clods in the air
};

/// Applies the change to `ground`. Changed tiles get a new version.
void Apply(const TerrainChange& change, TerrainSurface* ground);

/// Finds the changes of a ground from step to step.
class TerrainTracker {
 public:
  /// `ground` is the initial ground, which readers of the recording have too.
  explicit TerrainTracker(const TerrainSurface& ground);

  /// Differences between `now` and the known ground.
  TerrainChange Find(const TerrainSurface& now);
  /// Applies the change to the known ground.
  void Accept(const TerrainChange& change) { Apply(change, &known_); }
  const TerrainSurface& known() const { return known_; }

 private:
  void CompareTile(const TerrainSurface& now, int a, int b, TerrainChange* change) const;

  TerrainSurface known_;
  std::vector<std::uint32_t> version_;  ///< version of each tile when it was last compared
};

}  // namespace tera
