#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Grid of square cells over a survey, in rows from the south, x fastest.
struct CellGrid {
  Vec2 low_m = Vec2::Zero();  ///< south-western corner of the first cell
  double cell_m = 1;
  int nx = 0, ny = 0;

  std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * nx + i; }
  bool Has(int i, int j) const { return i >= 0 && j >= 0 && i < nx && j < ny; }
  Vec2 MiddleOf(int i, int j) const { return low_m + cell_m * Vec2(i + 0.5, j + 0.5); }
  /// Column or row that contains a coordinate. A coordinate on the upper border belongs to the last
  /// one.
  int Column(double x_m) const {
    return std::clamp(static_cast<int>(std::floor((x_m - low_m.x()) / cell_m)), 0, nx - 1);
  }
  int Row(double y_m) const {
    return std::clamp(static_cast<int>(std::floor((y_m - low_m.y()) / cell_m)), 0, ny - 1);
  }
  std::size_t CellOf(const Vec3& p_m) const { return At(Column(p_m.x()), Row(p_m.y())); }
};

/// Grid with cells of `cell_m` that covers all points. Its corner is at a multiple of `cell_m`.
inline CellGrid GridOver(const std::vector<Vec3>& p_m, double cell_m) {
  Vec2 low_m = p_m.front().head<2>(), high_m = low_m;
  for (const Vec3& p : p_m) {
    low_m = low_m.cwiseMin(p.head<2>());
    high_m = high_m.cwiseMax(p.head<2>());
  }
  CellGrid grid;
  grid.cell_m = cell_m;
  grid.low_m = cell_m * (low_m / cell_m).array().floor().matrix();
  grid.nx = std::max(2, static_cast<int>(std::floor((high_m.x() - grid.low_m.x()) / cell_m)) + 1);
  grid.ny = std::max(2, static_cast<int>(std::floor((high_m.y() - grid.low_m.y()) / cell_m)) + 1);
  return grid;
}

/// NaN marks an unknown height.
inline bool IsKnown(float height_m) { return !std::isnan(height_m); }

}  // namespace tera
