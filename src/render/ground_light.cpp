#include "render/ground_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tera {
namespace {

constexpr float kNoShadowDepth_m = 100.0f;  // below the ground at the site's sunny border

/// Walks the grid so that the line that casts shadow on a line is done before it.
struct Sweep {
  bool along_x;       ///< lines are columns (constant i), else rows (constant j)
  int lines, across;  ///< number of lines, vertices on each
  int first, step;    ///< first line done and the way on
  double drift;       ///< vertices across, per line towards the sun
  double drop_m;      ///< of the shadow from one line to the next
};

Sweep PlanSweep(const TerrainSurface& terrain, const Vec3& to_sun_W) {
  Sweep s;
  s.along_x = std::abs(to_sun_W.x()) >= std::abs(to_sun_W.y());
  const double major = s.along_x ? to_sun_W.x() : to_sun_W.y();
  const double minor = s.along_x ? to_sun_W.y() : to_sun_W.x();
  s.lines = s.along_x ? terrain.nx : terrain.ny;
  s.across = s.along_x ? terrain.ny : terrain.nx;
  s.step = major > 0 ? -1 : 1;
  s.first = major > 0 ? s.lines - 1 : 0;
  s.drift = minor / std::abs(major);
  s.drop_m = terrain.cell_m * to_sun_W.z() / std::abs(major);
  return s;
}

}  // namespace

SkyView::SkyView(double cell_m) {
  constexpr std::array<std::array<int, 2>, 8> kDirections = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  constexpr std::array<double, 5> kReaches_m = {0.05, 0.15, 0.3, 0.6, kOcclusionReach_m};
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    const auto [x, y] = kDirections[d];
    const double unit = x != 0 && y != 0 ? std::sqrt(0.5) : 1.0;
    for (std::size_t r = 0; r < kReaches_m.size(); ++r) {
      const int steps = std::max(1, static_cast<int>(std::lround(kReaches_m[r] * unit / cell_m)));
      directions_[d][r] = {x * steps, y * steps, static_cast<float>(steps * cell_m / unit)};
    }
  }
}

float SkyView::Factor(const TerrainSurface& terrain, int i, int j) const {
  const float h = terrain.height_m[terrain.index(i, j)];
  float sum = 0;
  for (const auto& samples : directions_) {
    float steepest = 0;  // tangent of the horizon's height
    for (const Sample& s : samples) {
      const int a = std::clamp(i + s.di, 0, terrain.nx - 1);
      const int b = std::clamp(j + s.dj, 0, terrain.ny - 1);
      steepest = std::max(steepest, (terrain.height_m[terrain.index(a, b)] - h) / s.distance_m);
    }
    sum += 1.0f / (1.0f + steepest * steepest);
  }
  return sum / directions_.size();
}

std::vector<float> ShadowHeights(const TerrainSurface& terrain, const Vec3& to_sun_W) {
  std::vector<float> shadow(terrain.height_m.size());
  for (std::size_t v = 0; v < shadow.size(); ++v)
    shadow[v] = terrain.height_m[v] - kNoShadowDepth_m;
  const Vec2 horizontal = to_sun_W.head<2>();
  if (horizontal.norm() < 1e-6 * std::abs(to_sun_W.z())) return shadow;  // sun at the zenith
  const Sweep s = PlanSweep(terrain, to_sun_W);
  const std::size_t line_stride = s.along_x ? 1 : static_cast<std::size_t>(terrain.nx);
  const std::size_t across_stride = s.along_x ? static_cast<std::size_t>(terrain.nx) : 1;
  const auto drop_m = static_cast<float>(s.drop_m);
  const int whole = static_cast<int>(std::floor(s.drift));
  const auto part = static_cast<float>(s.drift - whole);
  for (int n = 1; n < s.lines; ++n) {
    const int line = s.first + n * s.step;
    const std::size_t here = line * line_stride, sunward = (line - s.step) * line_stride;
    const auto caster = [&](int k) {
      const std::size_t v = sunward + std::clamp(k, 0, s.across - 1) * across_stride;
      return std::max(terrain.height_m[v], shadow[v]);
    };
    for (int k = 0; k < s.across; ++k) {
      const float a = caster(k + whole), b = caster(k + whole + 1);
      shadow[here + k * across_stride] = a + part * (b - a) - drop_m;
    }
  }
  return shadow;
}

}  // namespace tera
