#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "render/scene.h"

namespace tera {

/// Poses of a camera and all bodies.
struct PosedView {
  const Pose& X_WC;
  const std::vector<Pose>& X_WB;
};

/// Largest image displacement, in pixels, of the visible surfaces between two times.
///
/// Model   every kProbe_px-th pixel of `frame`, rendered from `then`, yields a surface point that
///         moves with its instance's body. For an instance of several bodies, the largest
///         displacement of these bodies counts. Ground is static; points without depth are
///         infinitely far.
/// Omits   surfaces that the probes miss, and points that leave the lens's field.
double ImageMotion_px(const SceneModel& model, const CameraIntrinsics& lens,
                      const CameraFrame& frame, const PosedView& then, const PosedView& other);

}  // namespace tera
