#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "render/gl/angular_lens.h"
#include "render/gl/camera_intrinsics.h"

namespace tera {
namespace {

struct DistortedPoint {
  Vec2 value;
  Eigen::Matrix2d jacobian;
};

/// x'(x) of a perspective lens and its derivative.
DistortedPoint Distort(const CameraIntrinsics& c, const Vec2& p) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double above = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double below = 1 + r2 * (c.k4 + r2 * (c.k5 + r2 * c.k6));
  const double above_slope = c.k1 + r2 * (2 * c.k2 + r2 * 3 * c.k3);
  const double below_slope = c.k4 + r2 * (2 * c.k5 + r2 * 3 * c.k6);
  const double radial = above / below;
  const double slope = (above_slope - radial * below_slope) / below;  // d radial / d r2
  DistortedPoint d;
  d.value = {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
             y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
  d.jacobian << radial + 2 * x * x * slope + 2 * c.p1 * y + 6 * c.p2 * x,
      2 * x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,
      2 * x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,
      radial + 2 * y * y * slope + 6 * c.p1 * y + 2 * c.p2 * x;
  return d;
}

}  // namespace

bool CameraIntrinsics::Sees(const Vec3& p_C_m) const {
  if (IsAngular()) return AngleFromAxis(p_C_m) <= 0.5 * field_rad;
  return p_C_m.z() > 0 && p_C_m.head<2>().norm() <= kWidestTangent * p_C_m.z();
}

Vec2 CameraIntrinsics::Project(const Vec3& p_C_m) const {
  Vec2 x;
  if (IsAngular()) {
    x = RadiusAt(*this, AngleFromAxis(p_C_m)).rho * p_C_m.head<2>().stableNormalized();
  } else {
    TERA_CHECK(p_C_m.z() > 0, p_C_m.z());
    x = Distort(*this, p_C_m.head<2>() / p_C_m.z()).value;
  }
  return {fx_px * x.x() + cx_px, fy_px * x.y() + cy_px};
}

Vec3 CameraIntrinsics::Unproject(const Vec2& pixel_px) const {
  const Vec2 target((pixel_px.x() - cx_px) / fx_px, (pixel_px.y() - cy_px) / fy_px);
  if (IsAngular()) return AlongAngle(AngleOf(*this, target.norm()), target);
  constexpr int kMaxIterations = 50;
  constexpr double kConverged = 1e-13;  // on the image plane at unit distance
  Vec2 x = target;
  for (int i = 0; i < kMaxIterations; ++i) {
    const DistortedPoint d = Distort(*this, x);
    const Vec2 step = d.jacobian.inverse() * (d.value - target);
    if (!step.allFinite()) break;
    x -= step;
    if (step.norm() < kConverged) break;
  }
  return {x.x(), x.y(), 1.0};
}

std::optional<Vec3> CameraIntrinsics::RayOf(const Vec2& pixel_px) const {
  constexpr double kRoundTrip_px = 1e-3;
  const Vec3 ray = Unproject(pixel_px);
  const bool usable =
      ray.allFinite() && Sees(ray) && (Project(ray) - pixel_px).norm() < kRoundTrip_px;
  return usable ? std::optional(ray) : std::nullopt;
}

std::optional<Vec2> CameraIntrinsics::PixelWithoutRay() const {
  if (IsAngular()) return PixelWhereItFolds(*this);
  constexpr int kGrid = 64;  // grid lines along each side
  const int last_u = width_px - 1, last_v = height_px - 1;
  const int step_u = std::max(1, width_px / kGrid), step_v = std::max(1, height_px / kGrid);
  for (int v = 0; v <= last_v; ++v) {
    const bool whole_row = v == 0 || v == last_v;
    for (int u = 0; u <= last_u; ++u) {
      const bool border = whole_row || u == 0 || u == last_u;
      if (!border && (u % step_u != 0 || v % step_v != 0)) continue;
      if (!RayOf(Vec2(u, v))) return Vec2(u, v);
    }
  }
  return std::nullopt;
}

double CameraIntrinsics::Illumination(const Vec2& pixel_px) const {
  if (!IsAngular()) return std::pow(1 / Unproject(pixel_px).norm(), 4);
  const std::optional<Vec3> ray_C = RayOf(pixel_px);
  return ray_C ? SolidAnglePerArea(*this, AngleFromAxis(*ray_C)) : 0;
}

}  // namespace tera
