#include "layout/measures/elevation_map.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kUnknown_m = 1;     ///< 1 sigma of a height that nobody measured
constexpr double kLeast_m2 = 1e-12;  ///< variance of a point of a sensor without noise

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
      p_W_m.z() = ground.HeightAt(p_W_m.x(), p_W_m.y());
      cells.push_back({p_W_m, ground.NormalAt(p_W_m.x(), p_W_m.y()),
                       size_m.prod() / static_cast<double>(nx * ny)});
    }
  }
  return cells;
}

std::vector<ElevationMap::Expected> ElevationMap::ExpectedOf(const Viewer& viewer,
                                                             const std::vector<Cell>& cells,
                                                             double reflectance) const {
  const ViewField& field = viewer.field;
  const Pose X_SW = viewer.X_WS.inverse();
  std::vector<Expected> expected;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Vec3 p_S_m = X_SW * cells[c].p_W_m;
    const double range_m = p_S_m.norm();
    const Vec3 d_W = viewer.X_WS.linear() * (p_S_m / range_m);
    const double cosine = -cells[c].normal_W.dot(d_W), up = cells[c].normal_W.z();
    if (cosine <= 0 || range_m < field.min_range_m) continue;
    if (range_m > std::min(field.max_range_m, field.reach_m(reflectance * cosine))) continue;
    const double area_m2 = cells[c].area_m2 / up;
    const double points =
        field.per_steradian(p_S_m / range_m) * area_m2 * cosine / (range_m * range_m);
    if (points <= 0) continue;
    expected.push_back({c, points, field.range_sigma_m(range_m) * cosine / up});
  }
  return expected;
}

void ElevationMap::Add(const Pose& X_WH, const Layout& layout, double reflectance,
                       const Sighting& sighting, const TerrainSurface& ground) {
  std::vector<Cell> cells = CellsOn(ground, X_WH);
  for (const Viewer& viewer : layout.viewers) {
    if (!viewer.field.ranges) continue;
    const std::vector<Expected> expected = ExpectedOf(viewer, cells, reflectance);
    std::vector<Sighting::Line> lines;
    for (const Expected& of : expected) {
      lines.push_back({viewer.X_WS.translation(), cells[of.cell].p_W_m});
    }
    const std::vector<std::optional<Blocked>> blocked = sighting.Try(lines);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (blocked[i]) continue;
      const auto& [c, points, sigma_m] = expected[i];
      cells[c].points += points;
      cells[c].weight_pm2 += points / std::max(sigma_m * sigma_m, kLeast_m2);
    }
  }
  Count(cells);
}

void ElevationMap::Count(const std::vector<Cell>& cells) {
  double gaps = 0, variance_m2 = 0;
  for (const Cell& cell : cells) {
    const double gap = std::exp(-cell.points), unknown_m2 = kUnknown_m * kUnknown_m;
    gaps += gap;
    const double measured_m2 = 1 / (cell.weight_pm2 + 1 / unknown_m2);
    variance_m2 += gap * unknown_m2 + (1 - gap) * measured_m2;
  }
  cells_ = cells.size();
  const auto n = static_cast<double>(cells.size());
  gaps_.push_back(gaps / n);
  sigma_m_.push_back(std::sqrt(variance_m2 / n));
}

std::vector<Figure> ElevationMap::Figures() const {
  Figure gaps{"elevation/gaps", "", false, gaps_, {}};
  for (const double share : gaps_) gaps.error.push_back(ShareError(share, cells_));
  Figure sigma{"elevation/sigma_m", "m", false, sigma_m_, std::vector<double>(sigma_m_.size(), 0)};
  return {gaps, sigma};
}

}  // namespace tera
