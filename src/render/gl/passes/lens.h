#pragma once

#include <vector>

#include "render/gl/camera_intrinsics.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// One of the pinhole images that make up a lens image.
///
/// Frames  V the view's own optical frame, with its origin at the camera's eye.
struct LensView {
  Mat3 R_CV = Mat3::Identity();
  CameraIntrinsics pinhole;
};

/// A distorting lens as pinhole images that cover its field, with a map from lens pixels to pinhole
/// pixels.
///
/// Model   a single image for perspective lenses, and for lenses without a ray beyond
///         kWidestOfOne_rad from the axis. Other lenses use the cube faces that contain rays,
///         cropped to these rays. A small rotation keeps the faces' pixel rows from running along
///         the lens's rows. The images are finer than the lens image by kOversampling at its finest
///         point, so the nearest label pixel is at most 0.4 px away.
class Lens {
 public:
  /// Throws InputError if the lens folds the image over, or if a perspective lens has rays beyond
  /// CameraIntrinsics::kWidestTangent.
  explicit Lens(const CameraIntrinsics& camera);

  const CameraIntrinsics& camera() const { return camera_; }
  const std::vector<LensView>& views() const { return views_; }
  /// Texture with the source of each pixel: position x and y, view (-1 for dark pixels), and depth
  /// in the camera's image over depth in the view.
  const GlObject& map() const { return map_; }

  static constexpr double kOversampling = 1.25;
  static constexpr double kWidestOfOne_rad = 1.05;

 private:
  CameraIntrinsics camera_;
  std::vector<LensView> views_;
  GlObject map_;
};

}  // namespace tera
