#pragma once

#include <optional>

#include "core/motion.h"

namespace tera {

/// Pinhole intrinsics with Brown-Conrady distortion, as in OpenCV and ROS CameraInfo.
///
/// Frames  C optical frame (x right, y down, z forward). Pixel (0, 0) is the centre of the upper
///         left pixel.
/// Model   x = X/Z, y = Y/Z, r2 = x2 + y2;
///         x' = x (1 + k1 r2 + k2 r4 + k3 r6) + 2 p1 x y + p2 (r2 + 2 x2), y' likewise;
///         u = fx x' + cx, v = fy y' + cy.
/// Source  Brown 1971; OpenCV 4.6 calib3d documentation.
struct CameraIntrinsics {
  int width_px = 640, height_px = 480;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  double near_m = 0.05, far_m = 300.0;

  bool Distorted() const { return k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0; }
  /// Whether a point in C lies in the field within which the lens projects.
  bool Sees(const Vec3& p_C_m) const;
  /// Pixel of a point in C, Z > 0.
  Vec2 Project(const Vec3& p_C_m) const;
  /// Direction (x, y, 1) in C of a pixel, by Newton's method on the distortion.
  Vec3 Unproject(const Vec2& pixel_px) const;
  /// Unproject, but nothing where the distortion folds the picture over or turns the ray beyond
  /// kWidestTangent from the axis.
  std::optional<Vec3> RayOf(const Vec2& pixel_px) const;
  /// A pixel on the border, or of a grid over the picture, for which RayOf has nothing.
  std::optional<Vec2> PixelWithoutRay() const;

  static constexpr double kWidestTangent = 4.0;
};

}  // namespace tera
