#include "survey/site/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/check.h"

namespace tera {
namespace {

double Cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners of the convex hull, counterclockwise (Andrew's monotone chain).
std::vector<Vec2> ConvexHull(std::vector<Vec2> places_m) {
  std::sort(places_m.begin(), places_m.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Vec2> hull;
  const auto half = [&](auto first, auto last) {
    const std::size_t base = hull.size();
    for (auto place = first; place != last; ++place) {
      while (hull.size() >= base + 2 &&
             Cross(hull.back() - hull[hull.size() - 2], *place - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*place);
    }
    if (hull.size() > base + 1) hull.pop_back();  // first corner of the other half
  };
  half(places_m.begin(), places_m.end());
  half(places_m.rbegin(), places_m.rend());
  return hull;
}

Footprint Along(const std::vector<Vec2>& hull, double yaw_rad) {
  const Vec2 along(std::cos(yaw_rad), std::sin(yaw_rad)), across(-along.y(), along.x());
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec2 low(kFar, kFar), high(-kFar, -kFar);
  for (const Vec2& corner : hull) {
    const Vec2 at(along.dot(corner), across.dot(corner));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Vec2 middle = 0.5 * (low + high), size = high - low;
  return {middle.x() * along + middle.y() * across, yaw_rad, size.x(), size.y()};
}

}  // namespace

bool Footprint::Holds(const Vec2& place_m, double margin_m) const {
  const Vec2 along(std::cos(yaw_rad), std::sin(yaw_rad)), from = place_m - middle_m;
  return std::abs(along.dot(from)) <= 0.5 * length_m + margin_m &&
         std::abs(Cross(along, from)) <= 0.5 * width_m + margin_m;
}

Footprint LeastRectangle(std::vector<Vec2> places_m) {
  TERA_CHECK(!places_m.empty(), places_m.size());
  const std::vector<Vec2> hull = ConvexHull(std::move(places_m));
  Footprint least = Along(hull, 0);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2 side = hull[(k + 1) % hull.size()] - hull[k];
    if (side.squaredNorm() == 0) continue;
    const Footprint tried = Along(hull, std::atan2(side.y(), side.x()));
    if (tried.length_m * tried.width_m < least.length_m * least.width_m) least = tried;
  }
  if (least.width_m > least.length_m) {
    std::swap(least.width_m, least.length_m);
    least.yaw_rad += 0.5 * std::numbers::pi;
  }
  least.yaw_rad = std::remainder(least.yaw_rad, std::numbers::pi);
  return least;
}

}  // namespace tera
