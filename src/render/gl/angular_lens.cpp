#include "render/gl/angular_lens.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// Number of samples over the field.
constexpr int kSteps = 4000;

/// Image corner farthest from the principal point, with its radius.
struct Corner {
  Vec2 pixel_px;
  double rho = 0;
};

Corner FarthestCorner(const CameraIntrinsics& lens) {
  Corner farthest;
  for (const double u_px : {0.0, lens.width_px - 1.0}) {
    for (const double v_px : {0.0, lens.height_px - 1.0}) {
      const Vec2 x((u_px - lens.cx_px) / lens.fx_px, (v_px - lens.cy_px) / lens.fy_px);
      if (x.norm() >= farthest.rho) farthest = {{u_px, v_px}, x.norm()};
    }
  }
  return farthest;
}

}  // namespace

double AngleFromAxis(const Vec3& p_C) { return std::atan2(p_C.head<2>().norm(), p_C.z()); }

LensRadius RadiusAt(const CameraIntrinsics& c, double t) {
  if (c.kind == LensKind::kFTheta) {
    return {t * (1 + t * (c.k1 + t * (c.k2 + t * (c.k3 + t * c.k4)))),
            1 + t * (2 * c.k1 + t * (3 * c.k2 + t * (4 * c.k3 + t * 5 * c.k4)))};
  }
  const double t2 = t * t;
  return {t * (1 + t2 * (c.k1 + t2 * (c.k2 + t2 * (c.k3 + t2 * c.k4)))),
          1 + t2 * (3 * c.k1 + t2 * (5 * c.k2 + t2 * (7 * c.k3 + t2 * 9 * c.k4)))};
}

double AngleOf(const CameraIntrinsics& lens, double rho) {
  constexpr int kMaxIterations = 60;
  constexpr double kConverged_rad = 1e-14;
  double low = 0, high = 0.5 * lens.field_rad;
  if (rho >= RadiusAt(lens, high).rho) return high;
  double theta = std::min(rho, high);
  for (int i = 0; i < kMaxIterations; ++i) {
    const LensRadius at = RadiusAt(lens, theta);
    (at.rho < rho ? low : high) = theta;
    const double newton = theta - (at.rho - rho) / at.slope;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    const bool is_there = std::abs(next - theta) < kConverged_rad;
    theta = next;
    if (is_there) break;
  }
  return theta;
}

Vec3 AlongAngle(double theta_rad, const Vec2& side) {
  const Vec2 across = std::sin(theta_rad) * side.stableNormalized();
  return {across.x(), across.y(), std::cos(theta_rad)};
}

std::optional<Vec2> PixelWhereItFolds(const CameraIntrinsics& lens) {
  const Corner corner = FarthestCorner(lens);
  const Vec2 axis_px(lens.cx_px, lens.cy_px);
  for (int i = 0; i <= kSteps; ++i) {
    const LensRadius at = RadiusAt(lens, 0.5 * lens.field_rad * i / kSteps);
    if (at.rho > corner.rho) break;  // outside the image
    if (at.slope > 0) continue;
    const double share = corner.rho > 0 ? at.rho / corner.rho : 0;
    return (axis_px + share * (corner.pixel_px - axis_px)).array().round().matrix();
  }
  return std::nullopt;
}

double FieldInPicture_rad(const CameraIntrinsics& lens) {
  const double corner_rho = FarthestCorner(lens).rho;
  for (int i = 1; i <= kSteps; ++i) {
    const double theta_rad = 0.5 * lens.field_rad * i / kSteps;
    if (RadiusAt(lens, theta_rad).rho > corner_rho) return 2 * theta_rad;
  }
  return lens.field_rad;
}

double SolidAnglePerArea(const CameraIntrinsics& lens, double theta_rad) {
  constexpr double kNearAxis_rad = 1e-6;
  if (theta_rad < kNearAxis_rad) return 1;
  const LensRadius at = RadiusAt(lens, theta_rad);
  return std::sin(theta_rad) / (at.rho * at.slope);
}

}  // namespace tera
