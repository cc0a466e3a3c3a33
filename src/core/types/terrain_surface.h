#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Vertex grid of the ground.
///
/// Frames  W. Vertex (i, j) is at origin_W_m + cell_m * (i, j). Tiles of kTileCells x kTileCells
///         squares cover the grid; the last tiles may have fewer squares.
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

/// The visible ground: written by the soil model, read by cameras and lidars.
///
/// Frames  W. The surface is the triangle mesh over the vertices, each square split along the
///         diagonal from (i, j) to (i+1, j+1).
/// Model   Undisturbed ground stores a height at every `base_cells()`-th vertex and one cover per
///         tile; plane triangles join these vertices. Setting a vertex refines every tile that
///         contains it, borders included. Refinement allocates the tile's own vertices and does not
///         change the surface. A tile's version grows with each change, so that readers refresh
///         only dirty tiles. Weather wets and dries all ground alike: moisture that is set stays
///         within the bounds of its soil's Wetness.
class TerrainSurface : public TerrainGrid {
 public:
  /// Visible ground state at a vertex.
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

  /// Bounds that weather sets on the surface moisture of a soil. The scale is Cover::moisture's.
  struct Wetness {
    std::uint8_t least = 0, most = 255;
    bool operator==(const Wetness&) const = default;
  };

  /// A clod in the air or rolling down a slope.
  struct Grain {
    Eigen::Vector3f p_W_m = Eigen::Vector3f::Zero();  ///< centre
    float radius_m = 0;
    std::uint16_t number = 0;   ///< identifies a clod and selects its orientation
    std::uint8_t soil = 0;      ///< as in Cover
    std::uint8_t moisture = 0;  ///< as in Cover
  };

  TerrainSurface() = default;
  /// Level ground at height 0.
  explicit TerrainSurface(const TerrainGrid& grid);
  /// Undisturbed ground. `base_height_m` is row-major over every `base_cells`-th vertex and the
  /// last vertex along x and y. `tile_cover` has one entry per tile. `base_cells` divides
  /// kTileCells.
  TerrainSurface(const TerrainGrid& grid, int base_cells, std::vector<float> base_height_m,
                 std::vector<Cover> tile_cover);

  /// The vertex with its present moisture.
  Vertex at(int i, int j) const;
  /// The vertex as set, without changes of its moisture by weather.
  Vertex AsSet(int i, int j) const;
  float height_m(int i, int j) const;
  /// Height of the triangle mesh at (x, y) in W; outside the site, the nearest border value.
  double HeightAt(double x_m, double y_m) const;
  /// Height of the lowest vertex; visits all vertices.
  double Lowest_m() const;
  /// Upward unit normal of the triangle under (x, y).
  Vec3 NormalAt(double x_m, double y_m) const;

  /// Soil that moves through the air above the surface.
  const std::vector<Grain>& grains() const { return grains_; }
  void SetGrains(std::vector<Grain> grains) { grains_ = std::move(grains); }

  void Set(int i, int j, const Vertex& vertex);
  /// Moisture by weather, for each soil; ground of soils beyond the list keeps its moisture.
  void SetWetness(std::vector<Wetness> by_soil);
  /// Becomes equal to `other`. Copies only the tiles whose versions differ if both represent the
  /// same initial ground, otherwise all tiles.
  void Follow(const TerrainSurface& other);
  /// Allocates the vertices of tile (a, b) and of its border.
  void Refine(int a, int b);
  bool IsRefined(int a, int b) const { return block_of_[tile_index(a, b)] >= 0; }
  /// Vertex spacing of undisturbed tiles, in squares.
  int base_cells() const { return base_cells_; }
  /// Vertex spacing of tile (a, b), in squares.
  int step_cells(int a, int b) const { return IsRefined(a, b) ? 1 : base_cells_; }

  /// Starts at 1 and grows when a vertex of the tile or of its border changes.
  std::uint32_t tile_version(int a, int b) const { return version_[tile_index(a, b)]; }

 private:
  // A block holds the vertices that a tile owns: the lower left corners of its squares. At the end
  // of the grid it also holds the last vertices.
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
  std::vector<std::int32_t> block_of_;  ///< one per tile; -1 while undisturbed
  std::deque<Block> blocks_;            ///< 100 MB on a large site; growth moves no block
  std::vector<Grain> grains_;
  std::vector<Wetness> wetness_;
};

/// Number of base vertices along an axis of `n` vertices.
inline int BaseVertexCount(int n, int base_cells) { return (n - 2) / base_cells + 2; }
/// Vertex at which base vertex `a` stands.
inline int BaseVertex(int a, int n, int base_cells) { return std::min(a * base_cells, n - 1); }

}  // namespace tera
