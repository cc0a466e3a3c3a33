#pragma once

#include <optional>

#include "core/motion.h"

namespace tera {

/// What law takes directions to places on the picture.
enum class LensKind { kBrownConrady, kRational, kKannalaBrandt, kFTheta };

/// A camera's lens and its picture, as in OpenCV and ROS CameraInfo.
///
/// Frames  C optical frame (x right, y down, z forward). Pixel (0, 0) is the centre of the upper
///         left pixel.
/// Model   u = fx x' + cx, v = fy y' + cy.
///         Of perspective lenses, x = X/Z, y = Y/Z, r2 = x2 + y2,
///         x' = x (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + k6 r6)
///              + 2 p1 x y + p2 (r2 + 2 x2), y' likewise; without k4 to k6 it is Brown-Conrady's.
///         Of angular lenses, (x', y') = rho(theta) (X, Y) / |(X, Y)|, theta the angle from z:
///         Kannala-Brandt's rho = theta (1 + k1 theta2 + k2 theta4 + k3 theta6 + k4 theta8),
///         f-theta's rho = theta + k1 theta2 + k2 theta3 + k3 theta4 + k4 theta5. Light comes from
///         within field_rad alone; pixels beyond are dark.
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
  double field_rad = 3.0;  ///< full angle that an angular lens sees

  /// A lens that may look sideways and behind.
  bool IsAngular() const { return kind == LensKind::kKannalaBrandt || kind == LensKind::kFTheta; }
  bool Distorted() const {
    return IsAngular() || k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0 || k4 != 0 ||
           k5 != 0 || k6 != 0;
  }
  /// What a depth picture holds of a point in C: Z, or of an angular lens the distance.
  double DepthOf(const Vec3& p_C_m) const { return IsAngular() ? p_C_m.norm() : p_C_m.z(); }
  /// Whether a point in C lies in the field within which the lens projects.
  bool Sees(const Vec3& p_C_m) const;
  /// Pixel of a point in C; of perspective lenses Z > 0.
  Vec2 Project(const Vec3& p_C_m) const;
  /// The point of depth 1 in C that a pixel sees: (x, y, 1), or of an angular lens a unit vector.
  /// By Newton's method.
  Vec3 Unproject(const Vec2& pixel_px) const;
  /// Unproject, but nothing where the lens folds the picture over, where an angular lens's pixel
  /// lies beyond its field, or a perspective one's ray beyond kWidestTangent from the axis.
  std::optional<Vec3> RayOf(const Vec2& pixel_px) const;
  /// A pixel on the border, or of a grid over the picture, that has no ray though it ought to.
  std::optional<Vec2> PixelWithoutRay() const;
  /// Light on a pixel over that on the axis from the same luminance; 0 beyond the field.
  double Illumination(const Vec2& pixel_px) const;

  bool operator==(const CameraIntrinsics&) const = default;

  static constexpr double kWidestTangent = 4.0;
};

}  // namespace tera
