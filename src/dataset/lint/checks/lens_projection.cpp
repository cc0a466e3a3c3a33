#include "dataset/lint/checks/lens_projection.h"

namespace tera {
namespace {

/// Tangent of the largest angle off axis at which the distortion model is used.
constexpr double kFieldTangent = 1.2;
constexpr int kIterations = 20;
constexpr double kConverged_px = 0.01;

/// Distorted coordinates of a point at depth 1.
Vec2 Distorted(const Vec2& p, const CameraLens& lens) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  return {x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x),
          y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y};
}

}  // namespace

bool IsProjectable(const CameraLens& lens) { return lens.law == "brown_conrady"; }

std::optional<Vec2> Project(const Vec3& p_C_m, const CameraLens& lens) {
  if (p_C_m.z() <= 0) return std::nullopt;
  const Vec2 p = p_C_m.head<2>() / p_C_m.z();
  if (p.norm() > kFieldTangent) return std::nullopt;
  const Vec2 d = Distorted(p, lens);
  return Vec2(lens.fx_px * d.x() + lens.cx_px, lens.fy_px * d.y() + lens.cy_px);
}

std::optional<Vec3> RayOf(const Vec2& pixel_px, const CameraLens& lens) {
  const Vec2 seen((pixel_px.x() - lens.cx_px) / lens.fx_px,
                  (pixel_px.y() - lens.cy_px) / lens.fy_px);
  Vec2 p = seen;
  for (int i = 0; i < kIterations; ++i) p += seen - Distorted(p, lens);
  const Vec3 ray = Vec3(p.x(), p.y(), 1).normalized();
  const std::optional<Vec2> back = Project(ray, lens);
  if (!back || (*back - pixel_px).norm() > kConverged_px) return std::nullopt;
  return ray;
}

}  // namespace tera
