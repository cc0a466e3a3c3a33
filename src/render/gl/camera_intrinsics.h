#pragma once

#include <optional>

#include "core/motion.h"

namespace tera {

/// Projection law from directions to image points.
enum class LensKind { kBrownConrady, kRational, kKannalaBrandt, kFTheta };

/// A camera's lens and image size, with parameters as in OpenCV and ROS CameraInfo.
///
/// Frames  C optical frame (x right, y down, z forward). Pixel (0, 0) is the centre of the upper
///         left pixel.
/// Model   u = fx x' + cx, v = fy y' + cy.
///         Perspective lenses, with x = X/Z, y = Y/Z, r2 = x2 + y2:
///         x' = x (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + k6 r6) + 2 p1 x y + p2 (r2 + 2
///         x2), and y' likewise. Brown-Conrady has no k4 to k6.
///         Angular lenses, with theta the angle from z: (x', y') = rho(theta) (X, Y) / |(X, Y)|.
///         Kannala-Brandt: rho = theta (1 + k1 theta2 + k2 theta4 + k3 theta6 + k4 theta8).
///         f-theta: rho = theta + k1 theta2 + k2 theta3 + k3 theta4 + k4 theta5.
///         Pixels outside the field angle field_rad are dark.
/// Source  Brown 1971; OpenCV 4.6 calib3d documentation (pinhole and fisheye); Kannala and Brandt
///         2006, "A generic camera model and calibration method for conventional, wide-angle, and
///         fish-eye lenses".
struct CameraIntrinsics {
  int width_px = 640, height_px = 480;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  double near_m = 0.05, far_m = 300.0;
  LensKind kind = LensKind::kBrownConrady;
  double k4 = 0, k5 = 0, k6 = 0;
  double field_rad = 3.0;  ///< full field angle of an angular lens

  /// True for a fisheye, whose field may exceed a half space.
  bool IsAngular() const { return kind == LensKind::kKannalaBrandt || kind == LensKind::kFTheta; }
  bool Distorted() const {
    return IsAngular() || k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0 || k4 != 0 ||
           k5 != 0 || k6 != 0;
  }
  /// Depth of a point in C as depth images store it: Z, or the distance for an angular lens.
  double DepthOf(const Vec3& p_C_m) const { return IsAngular() ? p_C_m.norm() : p_C_m.z(); }
  /// True if a point in C lies where the lens can project it.
  bool Sees(const Vec3& p_C_m) const;
  /// Pixel of a point in C; perspective lenses need Z > 0.
  Vec2 Project(const Vec3& p_C_m) const;
  /// The point of depth 1 on a pixel's ray, in C: (x, y, 1), or a unit vector for an angular lens.
  /// Newton's method.
  Vec3 Unproject(const Vec2& pixel_px) const;
  /// Like Unproject, but empty for a pixel without a valid ray. Such a pixel lies where the lens
  /// folds the image over, beyond an angular lens's field, or beyond kWidestTangent of a
  /// perspective lens.
  std::optional<Vec3> RayOf(const Vec2& pixel_px) const;
  /// A pixel without a valid ray, or empty. Tests the border pixels and a grid over the image.
  std::optional<Vec2> PixelWithoutRay() const;
  /// Relative illumination of a pixel under uniform luminance: 1 on the axis, 0 beyond the field.
  double Illumination(const Vec2& pixel_px) const;

  bool operator==(const CameraIntrinsics&) const = default;

  static constexpr double kWidestTangent = 4.0;
};

}  // namespace tera
