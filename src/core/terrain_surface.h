#pragma once

#include <cstdint>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The visible ground: what the soil writes and what cameras and lidars see.
///
/// Frames  W. Vertex (i, j) stands at origin_W_m + cell_m * (i, j); arrays are row-major with i
///         fastest. The surface is the triangle mesh over the vertices, each square split along the
///         diagonal from (i, j) to (i+1, j+1).
/// Model   Tiles of kTileCells x kTileCells squares; `tile_version` grows whenever a vertex of that
///         tile (its border included) changes, so that readers refresh only what is dirty.
struct TerrainSurface {
  static constexpr int kTileCells = 50;

  Vec2 origin_W_m = Vec2::Zero();
  double cell_m = 0.05;
  int nx = 0, ny = 0;  ///< vertices along x and y
  std::vector<float> height_m;
  std::vector<std::uint8_t> soil;       ///< index into the scenario's list of soils
  std::vector<std::uint8_t> moisture;   ///< degree of saturation, 0..255 for 0..1
  std::vector<std::uint8_t> looseness;  ///< 0 undisturbed .. 255 freshly cut or dumped
  std::vector<std::uint8_t> rut;        ///< 0 none .. 255 freshly pressed by a track
  std::vector<std::uint32_t> tile_version;

  int tiles_x() const { return (nx - 2) / kTileCells + 1; }
  int tiles_y() const { return (ny - 2) / kTileCells + 1; }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * nx + i; }
  /// Height of the triangle mesh at (x, y) in W; the nearest border value outside the site.
  double HeightAt(double x_m, double y_m) const;
  /// Upward unit normal of the triangle under (x, y).
  Vec3 NormalAt(double x_m, double y_m) const;
};

}  // namespace tera
