#pragma once

#include <vector>

#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "sensors/camera/optics/optics_model.h"

namespace tera {

/// Ghosts of a small bright source in the image.
///
/// Model   light reflected by two lens surfaces forms an image of the round pupil at m (x - c) + c,
///         with the source at x and the principal point c. The ghost has the squared reflectance
///         times the source's light, spread uniformly with a soft rim. The camera's stream supplies
///         positions m, sizes and tints.
/// Omits   surfaces of real lenses; ghosts cut by rims; ghosts of sources outside the image.
/// Source  the linear position and the reflectances: Lee and Eisemann 2013, "Practical real-time
///         lens-flare rendering".
class Flare {
 public:
  Flare(const FlareModel& model, const CameraIntrinsics& camera, const Stream& draw);

  /// Adds the ghosts of a source that illuminates a plane in front of the lens with
  /// `illuminance_lx`.
  void Apply(const Vec2& source_px, const Vec3& illuminance_lx, Image<float>* picture) const;

 private:
  struct Ghost {
    double place;   ///< m
    double radius;  ///< fraction of the focal length
    Vec3 tint;      ///< mean 1
  };

  FlareModel model_;
  CameraIntrinsics camera_;
  std::vector<Ghost> ghosts_;
};

}  // namespace tera
