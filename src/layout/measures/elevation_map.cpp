#include "layout/measures/elevation_map.h"

#include <algorithm>
#include <cmath>

#include "layout/measures/polar_grid.h"
#include "layout/sight/look.h"

namespace tera {
namespace {

constexpr double kUnknown_m = 1;     ///< error at a moment without points
constexpr double kLeast_m2 = 1e-12;  ///< lower bound on a point's variance, for noiseless sensors

}  // namespace

std::vector<ElevationMap::Cell> ElevationMap::CellsOn(const TerrainSurface& ground,
                                                      const Pose& X_WH) const {
  const Vec2 size_m = study_.high_H_m - study_.low_H_m;
  const auto nx = std::max(1L, std::lround(size_m.x() / study_.cell_m));
  const auto ny = std::max(1L, std::lround(size_m.y() / study_.cell_m));
  std::vector<Cell> cells;
  for (long i = 0; i < nx; ++i) {
    for (long j = 0; j < ny; ++j) {
      const Vec2 share((static_cast<double>(i) + 0.5) / static_cast<double>(nx),
                       (static_cast<double>(j) + 0.5) / static_cast<double>(ny));
      const Vec2 xy_H_m = study_.low_H_m + share.cwiseProduct(size_m);
      Vec3 p_W_m = X_WH * Vec3(xy_H_m.x(), xy_H_m.y(), 0);
      if (!IsOnSite(ground, p_W_m)) continue;
      p_W_m.z() = ground.HeightAt(p_W_m.x(), p_W_m.y());
      cells.push_back({p_W_m, ground.NormalAt(p_W_m.x(), p_W_m.y()),
                       size_m.prod() / static_cast<double>(nx * ny)});
    }
  }
  return cells;
}

void ElevationMap::Add(const Pose& X_WH, const Layout& layout, double reflectance,
                       const Sighting& sighting, const TerrainSurface& ground) {
  std::vector<Cell> cells = CellsOn(ground, X_WH);
  std::vector<Target> targets;
  for (const Cell& cell : cells) targets.push_back({cell.p_W_m, cell.normal_W});
  const Asked asked{.reflectance = reflectance, .ranges = true};
  for (const Viewer& viewer : layout.viewers) {
    const std::vector<Look> looks = LookFrom(viewer, targets, asked, sighting);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (!looks[c].sees) continue;
      Cell& cell = cells[c];
      const Vec3 d_W = (cell.p_W_m - viewer.X_WS.translation()).normalized();
      const double up = cell.normal_W.z(), points = looks[c].per_m2 * cell.area_m2 / up;
      const double sigma_m = looks[c].sigma_m * -cell.normal_W.dot(d_W) / up;
      cell.points += points;
      cell.weight_pm2 += points / std::max(sigma_m * sigma_m, kLeast_m2);
    }
  }
  Count(cells);
}

void ElevationMap::Count(const std::vector<Cell>& cells) {
  double gaps = 0, measured = 0, variance_m2 = 0;
  for (const Cell& cell : cells) {
    const double gap = std::exp(-cell.points), has_points = -std::expm1(-cell.points);
    gaps += gap;
    measured += has_points;
    // The weight is that of the expected points. A non-empty cell has more points on average.
    if (cell.points > 0) variance_m2 += has_points * (has_points / cell.weight_pm2);
  }
  cells_.push_back(cells.size());
  gaps_.push_back(gaps / std::max(1.0, static_cast<double>(cells.size())));
  const double without_m = cells.empty() ? 0 : kUnknown_m;  // without any cell the error is 0
  sigma_m_.push_back(measured > 0 ? std::sqrt(variance_m2 / measured) : without_m);
}

std::vector<Figure> ElevationMap::Figures() const {
  Figure gaps{{Measure::kElevationGaps}, gaps_, {}};
  for (std::size_t m = 0; m < gaps_.size(); ++m) {
    gaps.error.push_back(ShareError(gaps_[m], cells_[m]));
  }
  Figure sigma{{Measure::kElevationSigma}, sigma_m_, std::vector<double>(sigma_m_.size(), 0)};
  return {gaps, sigma};
}

}  // namespace tera
