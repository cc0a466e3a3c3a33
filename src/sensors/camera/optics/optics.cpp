#include "sensors/camera/optics/optics.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "sensors/camera/pixel_rays.h"

namespace tera {
namespace {

constexpr double kSunRadius_rad = 0.2665 * kDeg;
constexpr double kSunDrawn_rad = 0.45 * kDeg;  // radius in the image, including the soft edge
constexpr float kBesideSun_cdpm2 = 2e4;        // upper bound of sky luminance near the sun

/// A pinhole whose field is the sun's disc.
CameraIntrinsics SunFinder() {
  constexpr int kSide_px = 24;
  CameraIntrinsics lens{.width_px = kSide_px, .height_px = kSide_px};
  lens.fx_px = lens.fy_px = 0.5 * kSide_px / std::tan(kSunRadius_rad);
  lens.cx_px = lens.cy_px = 0.5 * (kSide_px - 1);
  return lens;
}

Mat3 LookingAlong(const Vec3& z) {
  Mat3 R;
  R.col(2) = z;
  R.col(0) = z.unitOrthogonal();
  R.col(1) = z.cross(R.col(0));
  return R;
}

}  // namespace

std::uint8_t PixelOfShare(double share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

Optics::Optics(const OpticsModel& model, const CameraIntrinsics& camera, double f_number,
               double pixel_um, std::uint64_t seed, const std::string& stream_name)
    : model_(model), camera_(camera) {
  const double pixel_m = pixel_um * 1e-6, image_m = camera.fx_px * pixel_m;
  const double focal_m = model.focus_m ? 1 / (1 / image_m + 1 / *model.focus_m) : image_m;
  const double pupil_m = focal_m / f_number;
  if (model.focus_m) {
    lens_ = {pupil_m, image_m, pixel_m, *model.focus_m};
    discs_.emplace(std::max(lens_.Radius_px(camera.near_m), lens_.Radius_px(0)));
  }
  if (model.glare) {
    glare_.emplace(*model.glare, camera);
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        rays_C_.push_back(camera.RayOf(Vec2(x, y)).value_or(Vec3::Zero()));
      }
    }
  }
  if (model.flare) flare_.emplace(*model.flare, camera, Stream(seed, stream_name + "/flare"));
  if (model.soiling) {
    soiling_.emplace(*model.soiling, camera, 1e3 * pupil_m, Stream(seed, stream_name + "/soiling"),
                     stream_name);
  }
}

Vec3 Optics::SunBeforeLens_lx(const SeenScene& scene, const Vec3& to_sun_C,
                              Rasterizer* rasterizer) const {
  const Vec3 sun_lx = rasterizer->sun_illuminance_lx();
  if (to_sun_C.z() <= 0 || !(sun_lx.maxCoeff() > 0)) return Vec3::Zero();
  const Pose X_WC = scene.X_WC * MakePose(Vec3::Zero(), LookingAlong(to_sun_C));
  const CameraFrame disc = rasterizer->Render(SunFinder(), X_WC, scene.state);
  const auto sky =
      std::ranges::count(disc.semantic.data, static_cast<std::uint8_t>(SemanticClass::kSky));
  return sun_lx * (static_cast<double>(sky) / static_cast<double>(disc.semantic.data.size()));
}

void Optics::Scatter(const Vec3& to_sun_C, const Vec3& sun_lx, Image<float>* picture) const {
  Image<float> sources = *picture;
  for (std::size_t i = 0; i < rays_C_.size(); ++i) {
    if (rays_C_[i].isZero() ||
        rays_C_[i].normalized().cross(to_sun_C).norm() > std::sin(kSunDrawn_rad) ||
        rays_C_[i].dot(to_sun_C) < 0) {
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      sources.data[3 * i + c] = std::min(sources.data[3 * i + c], kBesideSun_cdpm2);
    }
  }
  glare_->Apply(sources, picture);
  if (sun_lx.maxCoeff() > 0) {
    AddSourceGlare(*model_.glare, rays_C_, to_sun_C, sun_lx, picture);
  }
}

void Optics::Apply(const SeenScene& scene, const Image<float>& depth_m, Rasterizer* rasterizer,
                   Image<float>* picture) const {
  if (discs_) *picture = Defocused(lens_, *discs_, depth_m, *picture);
  if (!glare_ && !flare_ && !soiling_) return;
  const Vec3 to_sun_C =
      scene.X_WC.linear().transpose() * rasterizer->model().environment.to_sun_W.normalized();
  const Vec3 sun_lx = SunBeforeLens_lx(scene, to_sun_C, rasterizer);
  if (soiling_) soiling_->Apply(std::max(to_sun_C.z(), 0.0) * sun_lx, picture);
  if (glare_) Scatter(to_sun_C, sun_lx, picture);
  if (!flare_ || !(sun_lx.maxCoeff() > 0) || !camera_.Sees(to_sun_C)) return;
  const Vec2 sun_px = camera_.Project(to_sun_C);
  const bool is_in_picture = sun_px.x() > -0.5 && sun_px.y() > -0.5 &&
                             sun_px.x() < camera_.width_px - 0.5 &&
                             sun_px.y() < camera_.height_px - 0.5;
  if (is_in_picture) flare_->Apply(sun_px, to_sun_C.z() * sun_lx, picture);
}

Image<std::uint8_t> Optics::SoilingLabel() const {
  Image<std::uint8_t> label(camera_.width_px, camera_.height_px);
  std::fill(label.data.begin(), label.data.end(), PixelOfShare(1));
  if (!soiling_) return label;
  const Image<float>& share = soiling_->transmitted();
  for (std::size_t i = 0; i < share.data.size(); ++i) {
    label.data[i] = PixelOfShare(double(share.data[i]));
  }
  return label;
}

}  // namespace tera
