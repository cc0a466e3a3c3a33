#include "render/air/sun_through_dust.h"

#include <cmath>

namespace tera {
namespace {

/// Sum of extinction times step length, from the first step beyond the cell.
double DepthFrom(const DustVolume& dust, const Vec3& middle, const Vec3& step) {
  double sum = 0;
  for (Vec3 at = middle + step;; at += step) {
    const auto i = static_cast<int>(std::floor(at.x())), j = static_cast<int>(std::floor(at.y())),
               k = static_cast<int>(std::floor(at.z()));
    if (i < 0 || j < 0 || k < 0 || i >= dust.nx || j >= dust.ny || k >= dust.nz) break;
    sum += dust.extinction_1pm[(static_cast<std::size_t>(k) * dust.ny + j) * dust.nx + i];
  }
  return sum * dust.cell_m;
}

}  // namespace

std::vector<float> OpticalDepthsToSun(const DustVolume& dust, const Vec3& to_sun_W) {
  constexpr float kThin_1pm = 1e-5f;
  std::vector<float> depths(dust.extinction_1pm.size(), 0.0f);
  std::size_t at = 0;
  for (int k = 0; k < dust.nz; ++k) {
    for (int j = 0; j < dust.ny; ++j) {
      for (int i = 0; i < dust.nx; ++i, ++at) {
        if (dust.extinction_1pm[at] < kThin_1pm) continue;
        const double own = 0.5 * dust.cell_m * dust.extinction_1pm[at];
        depths[at] =
            static_cast<float>(own + DepthFrom(dust, Vec3(i + 0.5, j + 0.5, k + 0.5), to_sun_W));
      }
    }
  }
  return depths;
}

}  // namespace tera
