#pragma once

#include <vector>

#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "sensors/camera/optics/optics_model.h"

namespace tera {

/// Ghosts of a small bright source in the image.
///
/// Model   Light reflected by two lens surfaces forms an image of the round pupil at c + m (x - c),
///         where x is the source and c the principal point. A ghost contains the squared
///         reflectance times the light of the source, uniform with a soft rim. Positions m, sizes
///         and tints are drawn from the camera's random stream.
/// Omits   Surfaces of real lenses; ghosts cut by rims; ghosts of sources outside the image.
/// Source  The linear position and the reflectances: Lee and Eisemann 2013, "Practical real-time
///         lens-flare rendering".
class Flare {
 public:
  Flare(const FlareModel& model, const CameraIntrinsics& camera, const Stream& draw);

  /// Adds the ghosts of a source that illuminates a plane in front of the lens with
  /// `illuminance_lx`.
  void Apply(const Vec2& source_px, const Vec3& illuminance_lx, Image<float>* picture) const;

 private:
  struct Ghost {
    double place;   ///< factor m of the position
    double radius;  ///< radius / focal length
    Vec3 tint;      ///< colour, with mean 1
  };

  FlareModel model_;
  CameraIntrinsics camera_;
  std::vector<Ghost> ghosts_;
};

}  // namespace tera
