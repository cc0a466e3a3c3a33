#pragma once

#include "render/gl/camera_intrinsics.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// A distorting lens as a pinhole picture that covers its field, and a map from the lens' pixels to
/// that picture's.
///
/// Model   the pinhole picture is finer than the lens' own by kOversampling where the lens is
///         finest, so that the nearest pixel's label is never further off than 0.4 px.
class Lens {
 public:
  /// Throws InputError if the distortion folds the picture over or turns rays beyond
  /// CameraIntrinsics::kWidestTangent from the axis.
  explicit Lens(const CameraIntrinsics& camera);

  const CameraIntrinsics& camera() const { return camera_; }
  const CameraIntrinsics& pinhole() const { return pinhole_; }
  /// Texture of source pixel positions, one for each pixel of the camera.
  const GlObject& map() const { return map_; }

  static constexpr double kOversampling = 1.25;

 private:
  CameraIntrinsics camera_, pinhole_;
  GlObject map_;
};

}  // namespace tera
