#pragma once

#include <vector>

#include "render/gl/camera_intrinsics.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// One pinhole picture of those that a lens's picture is taken from.
///
/// Frames  V the view's own optical frame, which stands in the camera's eye.
struct LensView {
  Mat3 R_CV = Mat3::Identity();
  CameraIntrinsics pinhole;
};

/// A lens that distorts as pinhole pictures that cover its field, and a map from the lens' pixels
/// to theirs.
///
/// Model   one picture where no ray leaves the axis by more than kWidestOfOne_rad, and of
///         perspective lenses always; else the faces of a cube that have rays, each cut to them,
///         and turned a little so that their pixels and the lens' do not run along each other.
///         The pictures are finer than the lens' own by kOversampling where the lens is finest, so
///         that the nearest pixel's label is never further off than 0.4 px.
class Lens {
 public:
  /// Throws InputError if the lens folds the picture over or a perspective one turns rays beyond
  /// CameraIntrinsics::kWidestTangent from the axis.
  explicit Lens(const CameraIntrinsics& camera);

  const CameraIntrinsics& camera() const { return camera_; }
  const std::vector<LensView>& views() const { return views_; }
  /// Texture of the source of each pixel: its position x and y, its view, of pixels without light
  /// -1, and its depth in the camera's picture over that in the view's.
  const GlObject& map() const { return map_; }

  static constexpr double kOversampling = 1.25;
  static constexpr double kWidestOfOne_rad = 1.05;

 private:
  CameraIntrinsics camera_;
  std::vector<LensView> views_;
  GlObject map_;
};

}  // namespace tera
