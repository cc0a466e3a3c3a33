#include "render/gl/passes/lens.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tera {
namespace {

/// Ray of a pixel, or an InputError where the lens model has none.
Vec2 RayOf(const CameraIntrinsics& camera, const Vec2& pixel_px) {
  if (const auto ray = camera.RayOf(pixel_px)) return ray->head<2>();
  throw InputError(fmt::format(
      "camera distortion k1 {} k2 {} p1 {} p2 {} k3 {} has no ray for pixel ({}, {}); need "
      "coefficients under which every pixel of the {} x {} picture sees its own direction",
      camera.k1, camera.k2, camera.p1, camera.p2, camera.k3, pixel_px.x(), pixel_px.y(),
      camera.width_px, camera.height_px));
}

/// Lens pixels for each pixel of a pinhole with the same focal length, at a ray: the larger
/// stretch.
double Stretch(const CameraIntrinsics& c, const Vec2& ray) {
  constexpr double kStep = 1e-4;
  Eigen::Matrix2d jacobian;
  for (int k = 0; k < 2; ++k) {
    const Vec2 d = kStep * Vec2::Unit(k);
    const Vec3 ahead(ray.x() + d.x(), ray.y() + d.y(), 1),
        behind(ray.x() - d.x(), ray.y() - d.y(), 1);
    jacobian.col(k) = (c.Project(ahead) - c.Project(behind)) / (2 * kStep);
  }
  jacobian.row(0) /= c.fx_px;
  jacobian.row(1) /= c.fy_px;
  return jacobian.jacobiSvd().singularValues()[0];
}

}  // namespace

Lens::Lens(const CameraIntrinsics& camera) : camera_(camera), pinhole_(camera) {
  const int width = camera.width_px, height = camera.height_px;
  std::vector<Vec2> rays;
  Eigen::AlignedBox2d field;
  double stretch = 1.0;
  constexpr int kProbe_px = 16;  // stretch varies slowly over the picture
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      rays.push_back(RayOf(camera, Vec2(u, v)));
      field.extend(rays.back());
      if (u % kProbe_px == 0 && v % kProbe_px == 0) {
        stretch = std::max(stretch, Stretch(camera, rays.back()));
      }
    }
  }
  pinhole_.k1 = pinhole_.k2 = pinhole_.p1 = pinhole_.p2 = pinhole_.k3 = 0;
  pinhole_.fx_px = camera.fx_px * stretch * kOversampling;
  pinhole_.fy_px = camera.fy_px * stretch * kOversampling;
  constexpr int kMargin_px = 2;
  pinhole_.cx_px = kMargin_px - field.min().x() * pinhole_.fx_px;
  pinhole_.cy_px = kMargin_px - field.min().y() * pinhole_.fy_px;
  pinhole_.width_px =
      static_cast<int>(std::ceil(field.sizes().x() * pinhole_.fx_px)) + 1 + 2 * kMargin_px;
  pinhole_.height_px =
      static_cast<int>(std::ceil(field.sizes().y() * pinhole_.fy_px)) + 1 + 2 * kMargin_px;
  std::vector<Eigen::Vector2f> sources;
  for (const Vec2& ray : rays) {
    sources.push_back(pinhole_.Project(Vec3(ray.x(), ray.y(), 1)).cast<float>());
  }
  map_ = MakeTexture(GL_RG32F, width, height, Filter::kNearest, Wrap::kClamp);
  glTextureSubImage2D(map_.id(), 0, 0, 0, width, height, GL_RG, GL_FLOAT, sources.data());
}

}  // namespace tera
