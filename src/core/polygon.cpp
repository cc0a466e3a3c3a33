#include "core/polygon.h"

#include <cmath>

namespace tera {
namespace {

double Cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

bool SegmentsCross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return Cross(b - a, c - a) * Cross(b - a, d - a) < 0 &&
         Cross(d - c, a - c) * Cross(d - c, b - c) < 0;
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> FirstCrossing(const std::vector<Vec2>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t m = k + 1; m < n; ++m) {
      if (SegmentsCross(corners[k], corners[(k + 1) % n], corners[m], corners[(m + 1) % n])) {
        return std::pair(k, m);
      }
    }
  }
  return std::nullopt;
}

double AreaOf(const std::vector<Vec2>& corners) {
  double twice = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    twice += Cross(corners[k], corners[(k + 1) % corners.size()]);
  }
  return 0.5 * std::abs(twice);
}

}  // namespace tera
