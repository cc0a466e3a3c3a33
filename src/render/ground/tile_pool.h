#pragma once

#include <vector>

#include "core/types/terrain_surface.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// Possible vertex strides of a tile, in cells.
inline constexpr std::array<int, 6> kTileStrides = {1, 2, 5, 10, 25, 50};

/// Vertices of one tile at every `step`-th vertex of the terrain, for drawing.
///
/// Model   kTileCells / step + 1 vertices along each side, row-major. Vertices beyond the border of
///         the site coincide with the last vertex, so their squares are degenerate.
struct TileGrid {
  int step_cells = 1;
  std::vector<Eigen::Vector3f> vertices_W_m;

  TileGrid(const TerrainSurface& terrain, int a, int b);
  int side() const { return TerrainGrid::kTileCells / step_cells + 1; }
  /// Largest height error if only every `stride_cells`-th vertex is drawn.
  float StrideError_m(int stride_cells) const;
};

/// Tiles of one resolution on the GPU, with index lists for this stride and coarser ones. Skirts
/// below the borders close the cracks between tiles of different stride.
class TilePool {
 public:
  explicit TilePool(int step_cells);

  /// Reserves a place for another tile and returns its number.
  int Add();
  void Send(int place, const TileGrid& tile);
  /// Draws a tile with a stride that is a multiple of the pool's step. Returns the number of
  /// triangles.
  int Draw(int place, int stride_cells) const;
  void Bind() const;

 private:
  struct IndexRange {
    std::size_t offset_bytes = 0;
    int count = 0;
  };
  int side() const { return TerrainGrid::kTileCells / step_cells_ + 1; }
  int tile_vertices() const { return side() * side() + 4 * side(); }
  int GridVertex(int i, int j) const { return j * side() + i; }
  int BorderVertex(int border, int k) const;
  int SkirtVertex(int border, int k) const { return (side() + border) * side() + k; }
  void AppendIndices(int stride, std::vector<std::uint16_t>* indices) const;
  void Grow();

  int step_cells_;
  int count_ = 0, capacity_ = 0;
  std::array<IndexRange, kTileStrides.size()> ranges_;
  GlObject vertices_, indices_, array_;
};

}  // namespace tera
