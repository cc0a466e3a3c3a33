#include "sim/scenario/footprint.h"

namespace tera {

std::array<Vec2, 4> Footprint::Corners_W_m() const {
  const Vec2 x = half_m.x() * Along(), y = half_m.y() * Across();
  return {middle_W_m + x + y, middle_W_m - x + y, middle_W_m - x - y, middle_W_m + x - y};
}

bool Meet(const Footprint& a, const Footprint& b, double gap_m) {
  const Vec2 between = b.middle_W_m - a.middle_W_m;
  const auto reach = [](const Footprint& f, const Vec2& axis) {
    return f.half_m.x() * std::abs(f.Along().dot(axis)) +
           f.half_m.y() * std::abs(f.Across().dot(axis));
  };
  for (const Vec2& axis : {a.Along(), a.Across(), b.Along(), b.Across()}) {
    if (std::abs(between.dot(axis)) >= reach(a, axis) + reach(b, axis) + gap_m) return false;
  }
  return true;
}

}  // namespace tera
