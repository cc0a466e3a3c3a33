#include "render/gl/passes/lens.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/units.h"
#include "render/gl/angular_lens.h"

namespace tera {
namespace {

constexpr int kNoView = -1;
constexpr double kFaceTurn_rad = 5 * kDeg;

void RequireRays(const CameraIntrinsics& camera) {
  const auto pixel_px = camera.PixelWithoutRay();
  if (!pixel_px) return;
  throw InputError(
      "",
      {FaultKind::kOutOfRange,
       fmt::format(
           "camera distortion k1 {} k2 {} p1 {} p2 {} k3 {} has no ray for pixel ({}, {}); need "
           "coefficients under which every pixel of the {} x {} picture sees its own direction",
           camera.k1, camera.k2, camera.p1, camera.p2, camera.k3, pixel_px->x(), pixel_px->y(),
           camera.width_px, camera.height_px)});
}

/// For each pixel, row by row: the point of depth 1 on its ray.
std::vector<std::optional<Vec3>> RaysOf(const CameraIntrinsics& camera) {
  std::vector<std::optional<Vec3>> rays;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) rays.push_back(camera.RayOf(Vec2(u, v)));
  }
  return rays;
}

/// Orientations of a cube's faces: ahead, right, left, below, above, behind. Each face is rotated
/// about its own axis. Without the rotation, the pixels of a lens row would all have the same
/// sub-pixel offset, and whole edges would shift.
std::array<Mat3, 6> CubeFaces(double turn_rad) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const auto facing = [&](const Vec3& right, const Vec3& down, const Vec3& ahead) {
    Mat3 R_CV;
    R_CV << right, down, ahead;
    return Mat3(R_CV * Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()));
  };
  return {facing(x, y, z),  facing(-z, y, x), facing(z, y, -x),
          facing(x, -z, y), facing(x, z, -y), facing(-x, y, -z)};
}

/// The views that a lens needs (pinholes not yet set), and the view of each ray.
struct Split {
  std::vector<LensView> views;
  std::vector<int> view_of_ray;
};

Split SplitBetweenViews(const CameraIntrinsics& camera,
                        const std::vector<std::optional<Vec3>>& rays) {
  const bool is_narrow = std::all_of(rays.begin(), rays.end(), [](const std::optional<Vec3>& ray) {
    return !ray || AngleFromAxis(*ray) <= Lens::kWidestOfOne_rad;
  });
  Split split;
  split.view_of_ray.assign(rays.size(), kNoView);
  const bool is_one = !camera.IsAngular() || is_narrow;
  const std::array<Mat3, 6> faces = CubeFaces(is_one ? 0 : kFaceTurn_rad);
  const std::size_t face_count = is_one ? 1 : faces.size();
  for (std::size_t f = 0; f < face_count; ++f) {
    bool is_used = false;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!rays[i] || split.view_of_ray[i] != kNoView) continue;
      const Vec3 d_V = faces[f].transpose() * *rays[i];
      if (face_count > 1 && d_V.z() < rays[i]->cwiseAbs().maxCoeff()) continue;
      split.view_of_ray[i] = static_cast<int>(split.views.size());
      is_used = true;
    }
    if (is_used) split.views.push_back({faces[f], {}});
  }
  return split;
}

/// Pixel density of the lens relative to a pinhole of equal focal length, at a ray (x, y, 1) of the
/// view. The larger of the two principal stretches.
double Stretch(const CameraIntrinsics& c, const Mat3& R_CV, const Vec2& ray) {
  constexpr double kStep = 1e-4;
  Eigen::Matrix2d jacobian;
  for (int k = 0; k < 2; ++k) {
    const Vec2 d = kStep * Vec2::Unit(k);
    const Vec3 ahead(ray.x() + d.x(), ray.y() + d.y(), 1),
        behind(ray.x() - d.x(), ray.y() - d.y(), 1);
    jacobian.col(k) = (c.Project(R_CV * ahead) - c.Project(R_CV * behind)) / (2 * kStep);
  }
  jacobian.row(0) /= c.fx_px;
  jacobian.row(1) /= c.fy_px;
  return jacobian.jacobiSvd().singularValues()[0];
}

/// Bounding box of the rays in the image plane of a view, and the lens's largest stretch there.
struct Field {
  Eigen::AlignedBox2d box;
  double stretch = 1.0;
};

CameraIntrinsics PinholeOf(const CameraIntrinsics& camera, const Field& field, int margin_px) {
  CameraIntrinsics pinhole;
  pinhole.near_m = camera.near_m;
  pinhole.far_m = camera.far_m;
  pinhole.fx_px = camera.fx_px * field.stretch * Lens::kOversampling;
  pinhole.fy_px = camera.fy_px * field.stretch * Lens::kOversampling;
  pinhole.cx_px = margin_px - field.box.min().x() * pinhole.fx_px;
  pinhole.cy_px = margin_px - field.box.min().y() * pinhole.fy_px;
  pinhole.width_px =
      static_cast<int>(std::ceil(field.box.sizes().x() * pinhole.fx_px)) + 1 + 2 * margin_px;
  pinhole.height_px =
      static_cast<int>(std::ceil(field.box.sizes().y() * pinhole.fy_px)) + 1 + 2 * margin_px;
  return pinhole;
}

/// Sets the pinhole of each view so that it contains the view's rays.
void FitPinholes(const CameraIntrinsics& camera, const std::vector<std::optional<Vec3>>& rays,
                 Split* split) {
  constexpr int kProbe_px = 16;  // the stretch varies slowly over the image
  constexpr int kMargin_px = 2;
  constexpr int kSeamMargin_px = 32;  // surfaces just beyond a seam affect the shading at the seam
  std::vector<Field> fields(split->views.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!rays[i]) continue;
    Field& field = fields[static_cast<std::size_t>(split->view_of_ray[i])];
    const Mat3& R_CV = split->views[static_cast<std::size_t>(split->view_of_ray[i])].R_CV;
    const Vec2 on_plane = (R_CV.transpose() * *rays[i]).hnormalized();
    field.box.extend(on_plane);
    const int u = static_cast<int>(i) % camera.width_px, v = static_cast<int>(i) / camera.width_px;
    if (u % kProbe_px == 0 && v % kProbe_px == 0) {
      field.stretch = std::max(field.stretch, Stretch(camera, R_CV, on_plane));
    }
  }
  for (std::size_t w = 0; w < fields.size(); ++w) {
    split->views[w].pinhole =
        PinholeOf(camera, fields[w], fields.size() > 1 ? kSeamMargin_px : kMargin_px);
  }
}

}  // namespace

Lens::Lens(const CameraIntrinsics& camera) : camera_(camera) {
  RequireRays(camera);
  const std::vector<std::optional<Vec3>> rays = RaysOf(camera);
  Split split = SplitBetweenViews(camera, rays);
  FitPinholes(camera, rays, &split);
  std::vector<Eigen::Vector4f> sources;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!rays[i]) {
      sources.emplace_back(0.0f, 0.0f, static_cast<float>(kNoView), 1.0f);
      continue;
    }
    const LensView& view = split.views[static_cast<std::size_t>(split.view_of_ray[i])];
    const Vec3 d_V = view.R_CV.transpose() * *rays[i];
    const Vec2 at_px = view.pinhole.Project(d_V);
    sources.emplace_back(static_cast<float>(at_px.x()), static_cast<float>(at_px.y()),
                         static_cast<float>(split.view_of_ray[i]), static_cast<float>(1 / d_V.z()));
  }
  views_ = std::move(split.views);
  map_ = MakeTexture(GL_RGBA32F, camera.width_px, camera.height_px, Filter::kNearest, Wrap::kClamp);
  glTextureSubImage2D(map_.id(), 0, 0, 0, camera.width_px, camera.height_px, GL_RGBA, GL_FLOAT,
                      sources.data());
}

}  // namespace tera
