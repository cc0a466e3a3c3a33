#pragma once

#include <vector>

#include "render/gl/camera_intrinsics.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// One of the pinhole images that make up the image of a lens.
///
/// Frames  V the view's own optical frame. Its origin is the camera's eye.
struct LensView {
  Mat3 R_CV = Mat3::Identity();
  CameraIntrinsics pinhole;
};

/// A distorting lens: pinhole views that cover its field, and a map from its pixels to theirs.
///
/// Model   one view suffices for perspective lenses, and for lenses without a ray beyond
///         kWidestOfOne_rad from the axis. Other lenses use those cube faces that contain rays,
///         cropped to these rays. The faces are rotated slightly, so that their pixel rows are not
///         parallel to those of the lens.
///         At the lens's finest point the views are kOversampling times as fine as the lens image.
///         The nearest label pixel is therefore at most 0.4 px away.
class Lens {
 public:
  /// Throws InputError if the lens folds the image over. Also if a perspective lens has rays beyond
  /// CameraIntrinsics::kWidestTangent.
  explicit Lens(const CameraIntrinsics& camera);

  const CameraIntrinsics& camera() const { return camera_; }
  const std::vector<LensView>& views() const { return views_; }
  /// Texture with the source of each lens pixel: position x and y in the view; index of the view
  /// (-1: the pixel is dark); ratio of the depth in the camera's image to the depth in the view.
  const GlObject& map() const { return map_; }

  static constexpr double kOversampling = 1.25;
  static constexpr double kWidestOfOne_rad = 1.05;

 private:
  CameraIntrinsics camera_;
  std::vector<LensView> views_;
  GlObject map_;
};

}  // namespace tera
