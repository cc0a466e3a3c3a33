#pragma once

#include <vector>

#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "sensors/camera/optics/optics_model.h"

namespace tera {

/// Ghosts of a small bright source that is in the picture.
///
/// Model   light that is reflected by one surface and again by another makes a picture of the round
///         pupil at m (x - c) + c, x the source's place, c the principal point. It has the square
///         of the reflectance of the source's light, spread evenly over the ghost, whose rim is
///         soft. Places m, sizes and tints of a lens are drawn from the camera's stream.
/// Omits   real lenses' surfaces; ghosts cut by rims, and those of sources beyond the picture.
/// Source  the linear place and the reflectances: Lee and Eisemann 2013, "Practical real-time
///         lens-flare rendering".
class Flare {
 public:
  Flare(const FlareModel& model, const CameraIntrinsics& camera, const Stream& draw);

  /// Adds the ghosts of a source that lights a plane before the lens with `illuminance_lx`.
  void Apply(const Vec2& source_px, const Vec3& illuminance_lx, Image<float>* picture) const;

 private:
  struct Ghost {
    double place;   ///< m
    double radius;  ///< of the focal length
    Vec3 tint;      ///< of mean 1
  };

  FlareModel model_;
  CameraIntrinsics camera_;
  std::vector<Ghost> ghosts_;
};

}  // namespace tera
