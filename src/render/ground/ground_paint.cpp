#include "render/ground/ground_paint.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kWhole_m = 0.02, kGone_m = 0.06;  ///< departure from the initial height

}  // namespace

Vec3 GroundPaint::Over(const Vec3& soil, double x_m, double y_m, double height_m,
                       double loose) const {
  const double gx = std::clamp((x_m - low_W_m.x()) / cell_m, 0.0, nx - 1.0);
  const double gy = std::clamp((y_m - low_W_m.y()) / cell_m, 0.0, ny - 1.0);
  const int i = std::min(static_cast<int>(gx), nx - 2), j = std::min(static_cast<int>(gy), ny - 2);
  const double u = gx - i, v = gy - j;
  const std::size_t at = static_cast<std::size_t>(j) * nx + i;
  // Returns a value: an Eigen expression would outlive its operands.
  const auto between = [&](const auto& values) -> decltype(values(at)) {
    return (1 - v) * ((1 - u) * values(at) + u * values(at + 1)) +
           v * ((1 - u) * values(at + nx) + u * values(at + nx + 1));
  };
  const double start = between([&](std::size_t k) { return static_cast<double>(start_m[k]); });
  const double moved_m = std::abs(height_m - start);
  const double kept = std::clamp((kGone_m - moved_m) / (kGone_m - kWhole_m), 0.0, 1.0);
  const double share = kept * (1 - loose);
  if (share <= 0) return soil;
  const Vec3 painted = between([&](std::size_t k) -> Vec3 { return albedo[k].cast<double>(); });
  return soil + share * (painted - soil);
}

}  // namespace tera
