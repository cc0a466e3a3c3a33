#include "survey/points/raster_steps.h"

#include <cmath>
#include <map>
#include <utility>

namespace tera {

std::vector<Vec3> WithoutSteps(const std::vector<Vec3>& p_m, const Vec2& pixel_m) {
  if (p_m.empty()) return {};
  using Pixel = std::pair<long, long>;
  const auto pixel_of = [&](const Vec3& p) {
    const Vec2 from = (p - p_m.front()).head<2>().cwiseQuotient(pixel_m);
    return Pixel(std::lround(from.x()), std::lround(from.y()));
  };
  std::map<Pixel, double> height_m;
  for (const Vec3& p : p_m) height_m[pixel_of(p)] = p.z();
  const double most_m = pixel_m.maxCoeff();
  std::vector<Vec3> kept_m;
  for (const Vec3& p : p_m) {
    const auto [i, j] = pixel_of(p);
    bool is_beside_step = false;
    for (long dj = -1; dj <= 1; ++dj) {
      for (long di = -1; di <= 1; ++di) {
        const auto other = height_m.find({i + di, j + dj});
        if (other == height_m.end()) continue;
        is_beside_step = is_beside_step || std::abs(other->second - p.z()) > most_m;
      }
    }
    if (!is_beside_step) kept_m.push_back(p);
  }
  return kept_m;
}

}  // namespace tera
