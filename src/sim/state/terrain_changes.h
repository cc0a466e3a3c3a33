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
  std::vector<int> refined_tiles;             ///< tiles whose vertices get their own positions
  std::vector<At> vertices;                   ///< tile by tile, row by row in each
  std::vector<TerrainSurface::Grain> grains;  ///< all moving grains
};

/// Applies the change to `ground`. Each changed tile gets a new version.
void Apply(const TerrainChange& change, TerrainSurface* ground);

/// Finds the changes of a ground from step to step.
class TerrainTracker {
 public:
  /// `ground` is the reader's initial ground.
  explicit TerrainTracker(const TerrainSurface& ground);

  /// The differences of `now` from the known ground.
  TerrainChange Find(const TerrainSurface& now);
  /// Applies the change to the known ground.
  void Accept(const TerrainChange& change) { Apply(change, &known_); }
  const TerrainSurface& known() const { return known_; }

 private:
  void CompareTile(const TerrainSurface& now, int a, int b, TerrainChange* change) const;

  TerrainSurface known_;
  std::vector<std::uint32_t> version_;  ///< version of each tile of `now` at its last comparison
};

}  // namespace tera
