#include "core/types/looks.h"

#include <cmath>

namespace tera {

Paint PaintFromSrgb(const Vec3& rgb, double opacity) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return {rgb.unaryExpr(linear), opacity};
}

}  // namespace tera
