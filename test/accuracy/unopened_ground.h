#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/types/terrain_surface.h"
#include "core/units.h"

namespace tera {

/// Lowest height of the ground so far at each place. Soil below it was never opened by a tool,
/// regardless of the soil above it.
class UnopenedGround {
 public:
  explicit UnopenedGround(const TerrainSurface& ground)
      : lowest_(ground), version_(ground.tile_count()) {}

  void Follow(const TerrainSurface& ground) {
    for (int b = 0; b < ground.tiles_y(); ++b) {
      for (int a = 0; a < ground.tiles_x(); ++a) {
        std::uint32_t& seen = version_[ground.tile_index(a, b)];
        if (std::exchange(seen, ground.tile_version(a, b)) == ground.tile_version(a, b)) continue;
        if (ground.IsRefined(a, b)) FollowTile(a, b, ground);
      }
    }
  }

  /// Depth of a point in unopened ground: the shortest distance to a place outside it, with a
  /// tolerance of one stride sideways.
  double DepthOf_m(const Vec3& p_W_m) const {
    constexpr double kStride_m = 0.2, kFarthest_m = 0.7, kStep_m = 0.1;
    double depth_m = lowest_.HeightAt(p_W_m.x(), p_W_m.y()) - p_W_m.z();
    for (double away_m = kStride_m; away_m - kStride_m < std::min(depth_m, kFarthest_m);
         away_m += kStep_m) {
      for (int i = 0; i < 8; ++i) {
        const double around_rad = i * kPi / 4;
        const Vec2 beside_m =
            p_W_m.head<2>() + away_m * Vec2(std::cos(around_rad), std::sin(around_rad));
        const double up_m = lowest_.HeightAt(beside_m.x(), beside_m.y()) - p_W_m.z();
        depth_m = std::min(depth_m, std::hypot(away_m - kStride_m, std::max(0.0, up_m)));
      }
    }
    return depth_m;
  }

  /// Index into the site's soils of the original ground at (x, y), by the nearest vertex.
  int SoilAt(double x_m, double y_m) const {
    const auto vertex = [&](double at_m, double origin_m, int count) {
      return std::clamp(static_cast<int>(std::lround((at_m - origin_m) / lowest_.cell_m)), 0,
                        count - 1);
    };
    return lowest_
        .at(vertex(x_m, lowest_.origin_W_m.x(), lowest_.nx),
            vertex(y_m, lowest_.origin_W_m.y(), lowest_.ny))
        .cover.soil;
  }

 private:
  void FollowTile(int a, int b, const TerrainSurface& ground) {
    constexpr int kCells = TerrainGrid::kTileCells;
    for (int j = b * kCells; j <= std::min(ground.ny - 1, (b + 1) * kCells); ++j) {
      for (int i = a * kCells; i <= std::min(ground.nx - 1, (a + 1) * kCells); ++i) {
        if (ground.height_m(i, j) < lowest_.height_m(i, j)) lowest_.Set(i, j, ground.at(i, j));
      }
    }
  }

  TerrainSurface lowest_;
  std::vector<std::uint32_t> version_;
};

}  // namespace tera
