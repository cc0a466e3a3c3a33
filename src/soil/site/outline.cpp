#include "soil/site/outline.h"

#include <fmt/format.h>

#include <string>

#include "core/polygon.h"

namespace tera {
namespace {

constexpr std::size_t kFewestCorners = 3;
constexpr double kLeastArea_m2 = 1e-4;

/// Message for a faulty outline; empty if it is valid.
std::string OutlineFault(const std::vector<Vec2>& p) {
  if (p.size() < kFewestCorners) {
    return fmt::format("{} corners found, need at least {}, each [x, y] in m", p.size(),
                       kFewestCorners);
  }
  if (const auto sides = FirstCrossing(p)) {
    return fmt::format("its sides {} and {} cross; name the corners in order around the region",
                       sides->first + 1, sides->second + 1);
  }
  if (AreaOf(p) < kLeastArea_m2) return "its corners enclose no area";
  return "";
}

}  // namespace

std::vector<Vec2> ReadOutline(const ConfigMap& item) {
  std::vector<Vec2> outline_W_m;
  for (const auto& row : item.NumberRows("outline_m", Any("m"), 2, 0)) {
    outline_W_m.emplace_back(row[0], row[1]);
  }
  const std::string fault = OutlineFault(outline_W_m);
  if (fault.empty()) return outline_W_m;
  item.Fault("outline_m", fault);
  return {};
}

bool Encloses(const std::vector<Vec2>& outline_W_m, const Vec2& p) {
  bool inside = false;  // parity of the crossings of a ray towards +x
  for (std::size_t k = 0, last = outline_W_m.size() - 1; k < outline_W_m.size(); last = k++) {
    const Vec2 &a = outline_W_m[k], &b = outline_W_m[last];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y());
    if (p.x() < x) inside = !inside;
  }
  return inside;
}

}  // namespace tera
