#pragma once

#include <array>

#include "render/gl/camera_intrinsics.h"

namespace tera {

/// A pinhole camera as the vertex shaders use it.
///
/// Frames  GPU positions are relative to the eye, along the axes of W, so that floats keep their
///         precision far from the origin of W.
/// Model   clip.xyw = (2 (fx X + (cx + 1/2) Z) / width - Z, likewise for y, Z); clip.z = near.
///         Depth near / Z falls from 1 at the near plane to 0 at infinity. Row 0 of the window is
///         row 0 of the image.
struct View {
  Vec3 eye_W_m;
  Mat3 R_WC;
  int width_px, height_px;
  double fx_px, fy_px, cx_px, cy_px;
  double near_m;

  View(const CameraIntrinsics& pinhole, const Pose& X_WC);

  Eigen::Matrix4f ClipFromRelative() const;
  /// True if both views are bit-identical.
  bool IsSame(const View& other) const;
  /// False only if the whole box, given in W, lies outside the image.
  bool Sees(const Vec3& box_min_W_m, const Vec3& box_max_W_m) const;
  bool SeesSphere(const Vec3& centre_W_m, double radius_m) const;

 private:
  struct Plane {
    Vec3 normal_W;
    double offset_m;  ///< inside: normal . p + offset >= 0
  };
  std::array<Plane, 5> planes_;
};

}  // namespace tera
