#include "render/ground/ground_cover.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {

double SnowShare(const Weather& weather, const TerrainSurface::Cover& cover, double normal_z) {
  if (weather.snow_depth_m <= 0) return 0;
  constexpr double kRoughness_m = 0.01, kHolds_deg = 35, kSlides_deg = 50, kFull = 255;
  const double worked = std::max(cover.looseness, cover.rut) / kFull;
  const double slope_deg = std::acos(std::clamp(normal_z, -1.0, 1.0)) / kDeg;
  const double held = std::clamp((kSlides_deg - slope_deg) / (kSlides_deg - kHolds_deg), 0.0, 1.0);
  return (1 - worked) * held * std::tanh(weather.snow_depth_m / (2.5 * kRoughness_m));
}

}  // namespace tera
