#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Grid of ground vertices.
///
/// Frames  W world. Vertex (i, j) is at origin_W_m + cell_m * (i, j). The grid is divided into
///         tiles of kTileCells x kTileCells squares; the last tile of a row or column may be
///         smaller.
struct TerrainGrid {
  static constexpr int kTileCells = 50;

  Vec2 origin_W_m = Vec2::Zero();
  double cell_m = 0.05;
  int nx = 0, ny = 0;  ///< vertices along x and y

  int tiles_x() const { return (nx - 2) / kTileCells + 1; }
  int tiles_y() const { return (ny - 2) / kTileCells + 1; }
  int tile_count() const { return tiles_x() * tiles_y(); }
  int tile_index(int a, int b) const { return b * tiles_x() + a; }
  double x_m(int i) const { return origin_W_m.x() + cell_m * i; }
  double y_m(int j) const { return origin_W_m.y() + cell_m * j; }
  bool Contains(int i, int j) const { return i >= 0 && j >= 0 && i < nx && j < ny; }
  bool IsBorderTile(int a, int b) const {
    return a == 0 || b == 0 || a == tiles_x() - 1 || b == tiles_y() - 1;
  }
  bool operator==(const TerrainGrid&) const = default;
};

/// The visible ground. The soil model writes it; cameras and lidars read it.
///
/// Frames  W world. The surface is a triangle mesh over the vertices. The diagonal of each square
///         runs from (i, j) to (i+1, j+1).
/// Model   A tile starts undisturbed: it stores a height at every `base_cells()`-th vertex and one
///         cover for the whole tile. Planar triangles connect these vertices. Setting a vertex
///         refines every tile that contains the vertex, tile borders included. A refined tile
///         stores all of its vertices; refinement itself does not change the surface. The version
///         of a tile grows with each change, so readers update only changed tiles. Weather limits
///         the moisture of all ground of one soil to the bounds in Wetness.
class TerrainSurface : public TerrainGrid {
 public:
  /// Visible state of the ground at a vertex.
  struct Cover {
    std::uint8_t soil = 0;       ///< index into the scenario's soils
    std::uint8_t moisture = 0;   ///< degree of saturation, 0..255 for 0..1
    std::uint8_t looseness = 0;  ///< 0 undisturbed .. 255 freshly cut or dumped
    std::uint8_t rut = 0;        ///< 0 none .. 255 freshly pressed by a track
    bool operator==(const Cover&) const = default;
  };
  struct Vertex {
    float height_m = 0;
    Cover cover;
    bool operator==(const Vertex&) const = default;
  };

  /// Bounds that weather imposes on the surface moisture of one soil, on the scale of
  /// Cover::moisture.
  struct Wetness {
    std::uint8_t least = 0, most = 255;
    bool operator==(const Wetness&) const = default;
  };

  /// A soil clod in the air or rolling down a slope.
  struct Grain {
    Eigen::Vector3f p_W_m = Eigen::Vector3f::Zero();  ///< centre
    float radius_m = 0;
    std::uint16_t number = 0;   ///< identifies the clod; also determines its orientation
    std::uint8_t soil = 0;      ///< as in Cover
    std::uint8_t moisture = 0;  ///< as in Cover
  };

  TerrainSurface() = default;
  /// Level ground at height 0.
  explicit TerrainSurface(const TerrainGrid& grid);
  /// Undisturbed ground. `base_height_m` is row-major over every `base_cells`-th vertex, plus the
  /// last vertex along x and y. `tile_cover` has one entry per tile. `base_cells` must divide
  /// kTileCells.
  TerrainSurface(const TerrainGrid& grid, int base_cells, std::vector<float> base_height_m,
                 std::vector<Cover> tile_cover);

  /// The vertex with its moisture limited by the weather's bounds.
  Vertex at(int i, int j) const;
  /// The vertex as stored, before the weather's bounds apply to its moisture.
  Vertex AsSet(int i, int j) const;
  float height_m(int i, int j) const;
  /// Height of the triangle mesh at (x, y) in W. Outside the site, returns the height of the
  /// nearest border point.
  double HeightAt(double x_m, double y_m) const;
  /// Height of the lowest vertex. The cost is linear in the number of vertices.
  double Lowest_m() const;
  /// Upward unit normal of the triangle under (x, y).
  Vec3 NormalAt(double x_m, double y_m) const;

  /// Clods that move above the surface.
  const std::vector<Grain>& grains() const { return grains_; }
  void SetGrains(std::vector<Grain> grains) { grains_ = std::move(grains); }

  void Set(int i, int j, const Vertex& vertex);
  /// Sets the moisture bounds, indexed by soil. A soil without an entry has no bounds.
  void SetWetness(std::vector<Wetness> by_soil);
  /// Makes this surface equal to `other`. Copies only tiles with different versions if both
  /// surfaces started from the same ground; otherwise copies all tiles.
  void Follow(const TerrainSurface& other);
  /// Allocates all vertices of tile (a, b), borders included.
  void Refine(int a, int b);
  bool IsRefined(int a, int b) const { return block_of_[tile_index(a, b)] >= 0; }
  /// Vertex spacing of undisturbed tiles, in squares.
  int base_cells() const { return base_cells_; }
  /// Vertex spacing of tile (a, b), in squares.
  int step_cells(int a, int b) const { return IsRefined(a, b) ? 1 : base_cells_; }

  /// Starts at 1. Grows when a vertex of the tile, borders included, changes.
  std::uint32_t tile_version(int a, int b) const { return version_[tile_index(a, b)]; }

 private:
  // Vertices owned by one tile: the lower left corners of its squares. The last tile along an axis
  // also owns the vertices at the end of the grid.
  static constexpr int kRowBits = 6;
  using Block = std::array<Vertex, 1 << (2 * kRowBits)>;
  struct Slot {
    int tile, local;
  };
  Slot SlotOf(int i, int j) const;
  float BaseHeight(int i, int j) const;
  template <typename Visit>
  void ForTilesAround(int i, int j, Visit visit);

  int base_cells_ = 1;
  int base_nx_ = 0;
  std::vector<float> base_height_m_;
  std::vector<Cover> tile_cover_;
  std::vector<std::uint32_t> version_;
  std::vector<std::int32_t> block_of_;  ///< index into blocks_ per tile; -1 if undisturbed
  std::deque<Block> blocks_;  ///< a deque, because growth must not copy 100 MB of a large site
  std::vector<Grain> grains_;
  std::vector<Wetness> wetness_;
};

/// Number of base vertices along an axis with `n` vertices.
inline int BaseVertexCount(int n, int base_cells) { return (n - 2) / base_cells + 2; }
/// Grid index of base vertex `a` on an axis with `n` vertices.
inline int BaseVertex(int a, int n, int base_cells) { return std::min(a * base_cells, n - 1); }

}  // namespace tera
