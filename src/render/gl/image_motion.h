#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "render/scene.h"

namespace tera {

/// Where a camera and all bodies are.
struct PosedView {
  const Pose& X_WC;
  const std::vector<Pose>& X_WB;
};

/// How far, in pixels, what a picture shows is from where it stands on it at another moment: the
/// most of all things.
///
/// Model   a point of each surface at every kProbe_px-th pixel of `frame`, which was rendered from
///         `then`, moves with the body of its instance, with all of an instance that has several;
///         ground stands still, and what has no depth is infinitely far.
/// Omits   things that the probes miss, and those that leave the lens's field.
double ImageMotion_px(const SceneModel& model, const CameraIntrinsics& lens,
                      const CameraFrame& frame, const PosedView& then, const PosedView& other);

}  // namespace tera
