#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "render/scene.h"

namespace tera {

/// Poses of a camera and all bodies at one time.
struct PosedView {
  const Pose& X_WC;
  const std::vector<Pose>& X_WB;
};

/// Largest displacement in the image, in pixels, of the visible surfaces between two times.
///
/// Model   `frame` is the image at `then`. Every kProbe_px-th pixel gives a surface point, which
///         moves with its instance's body to `other`. If an instance has several bodies, the
///         largest of their displacements counts. The ground is static. Pixels without depth are
///         infinitely far.
/// Omits   surfaces that no probed pixel shows, and points that leave the lens's field.
double ImageMotion_px(const SceneModel& model, const CameraIntrinsics& lens,
                      const CameraFrame& frame, const PosedView& then, const PosedView& other);

}  // namespace tera
