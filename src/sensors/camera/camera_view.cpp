#include "sensors/camera/camera_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

/// Distance from the centre of a pixel to its border.
constexpr double kHalf_px = 0.5;
constexpr double kColour_bytes = 3, kDepth_bytes = 2;  ///< bytes per pixel

bool IsInPicture(const CameraIntrinsics& lens, const Vec2& pixel_px) {
  return pixel_px.x() >= -kHalf_px && pixel_px.y() >= -kHalf_px &&
         pixel_px.x() <= lens.width_px - kHalf_px && pixel_px.y() <= lens.height_px - kHalf_px;
}

/// Image area per area of the plane spanned by small changes of a direction along x_C and y_C.
double PerPlane(const CameraIntrinsics& lens, const Vec3& d_C, const Vec3& x_C, const Vec3& y_C) {
  constexpr double kStep = 1e-4;
  const Vec2 pixel_px = lens.Project(d_C);
  const Vec2 dx_px = lens.Project(d_C + kStep * x_C) - pixel_px;
  const Vec2 dy_px = lens.Project(d_C + kStep * y_C) - pixel_px;
  return std::abs(dx_px.x() * dy_px.y() - dx_px.y() * dy_px.x()) / (kStep * kStep);
}

/// Pixels per steradian along `d_C`.
double PerSteradian(const CameraIntrinsics& lens, const Vec3& d_C) {
  if (!lens.Sees(d_C)) return 0;
  const Vec3 d1_C = d_C / lens.DepthOf(d_C);
  const Vec2 pixel_px = lens.Project(d1_C);
  if (!IsInPicture(lens, pixel_px)) return 0;
  if (lens.IsAngular()) {
    const Vec3 x_C = d1_C.unitOrthogonal();
    return PerPlane(lens, d1_C, x_C, d1_C.cross(x_C));
  }
  if (lens.Distorted()) {
    // A distorted lens may fold directions outside its field onto the image. The ray of the pixel
    // then differs from the direction.
    constexpr double kSame = 1e-6;
    const std::optional<Vec3> ray_C = lens.RayOf(pixel_px);
    if (!ray_C || (*ray_C / ray_C->z() - d1_C).norm() > kSame) return 0;
  }
  // The area of a plane per steradian is r^3 / z.
  return PerPlane(lens, d1_C, Vec3::UnitX(), Vec3::UnitY()) * std::pow(d1_C.norm(), 3);
}

}  // namespace

ViewField ViewOf(const CameraModel& model, double rate_hz) {
  ViewField view;
  view.samples = ViewField::Samples::kPixels;
  const CameraIntrinsics lens = model.intrinsics;
  const Mat3 R_CS = OpticalInSensor().linear().transpose();
  view.per_steradian = [lens, R_CS](const Vec3& d_S) { return PerSteradian(lens, R_CS * d_S); };
  view.by_depth = !lens.IsAngular();
  view.through_glass = model.rgb;
  view.ranges = model.depth;
  view.min_distance_m = std::max(model.depth_min_m, lens.near_m);
  view.max_distance_m = std::min(model.depth_max_m, lens.far_m);
  const bool is_depth_alone = !model.rgb && model.labels.none();
  const double reach_m =
      is_depth_alone ? view.max_distance_m : std::numeric_limits<double>::infinity();
  view.nearest_m = is_depth_alone ? view.min_distance_m : lens.near_m;
  view.reach_m = [reach_m](double) { return reach_m; };
  view.distance_sigma_m = [model, lens](double z_m) {
    return z_m * z_m * model.disparity_noise_px / (lens.fx_px * model.baseline_m);
  };
  view.bytes_per_sample = model.rgb * kColour_bytes + model.depth * kDepth_bytes;
  view.samples_per_s = rate_hz * lens.width_px * lens.height_px;
  return view;
}

}  // namespace tera
