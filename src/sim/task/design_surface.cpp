#include "sim/task/design_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

/// The point of the polygon's edge that is nearest to `p`.
Vec2 NearestOnEdge(const std::vector<Vec2>& corners, const Vec2& p) {
  Vec2 nearest = corners.front();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2& a = corners[k];
    const Vec2 side = corners[(k + 1) % corners.size()] - a;
    const double along = std::clamp((p - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
    const Vec2 foot = a + along * side;
    if ((foot - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = foot;
  }
  return nearest;
}

/// Whether `p` is inside the polygon: a ray along x crosses its edges an odd number of times.
bool IsInside(const std::vector<Vec2>& corners, const Vec2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

}  // namespace

double DesignSurface::InsideBy_m(const Vec2& xy_W_m) const {
  const double distance_m = (NearestOnEdge(corners_W_m, xy_W_m) - xy_W_m).norm();
  return IsInside(corners_W_m, xy_W_m) ? distance_m : -distance_m;
}

std::optional<double> DesignSurface::HeightAt(const Vec2& xy_W_m) const {
  if (IsInside(corners_W_m, xy_W_m)) return FloorAt(xy_W_m);
  const Vec2 edge_W_m = NearestOnEdge(corners_W_m, xy_W_m);
  const double beyond_m = (edge_W_m - xy_W_m).norm();
  if (beyond_m == 0) return FloorAt(xy_W_m);
  if (std::cos(side_rad) < std::numeric_limits<double>::epsilon()) return std::nullopt;
  return FloorAt(edge_W_m) + beyond_m * std::tan(side_rad);
}

}  // namespace tera
