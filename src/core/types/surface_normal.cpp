#include "core/types/surface_normal.h"

#include <algorithm>
#include <cmath>

namespace tera {

std::array<std::uint16_t, 3> PixelOfNormal(const Vec3& n_C) {
  std::array<std::uint16_t, 3> pixel;
  for (int k = 0; k < 3; ++k) {
    pixel[static_cast<std::size_t>(k)] = static_cast<std::uint16_t>(
        std::lround(kNormalScale * (std::clamp(n_C[k], -1.0, 1.0) + 1.0)));
  }
  return pixel;
}

std::optional<Vec3> NormalAt(const Image<std::uint16_t>& normal, int x_px, int y_px) {
  const Vec3 value(normal.at(x_px, y_px, 0), normal.at(x_px, y_px, 1), normal.at(x_px, y_px, 2));
  if (value.isZero()) return std::nullopt;
  return (value / kNormalScale - Vec3::Ones()).normalized();
}

}  // namespace tera
