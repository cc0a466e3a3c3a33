#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "core/workers.h"
#include "render/gl/camera_intrinsics.h"
#include "render/scene.h"

namespace tera {

/// Adds to each box what an object would cover alone, whatever is before it and wherever the
/// picture ends, and its key points.
///
/// Model   the amodal box is that of all corners of the object's triangles, cut at near_m. Beyond
///         the corners of the picture a lens that distorts goes on as a pinhole, and an angular one
///         has only what lies in its field. Truncation is the share of that box beyond the picture.
///         A key point is seen where the nearest pixel shows its object no further than the key
///         point's radius before it.
void AddWholeObjects(const SceneModel& model, const SceneState& state, const CameraIntrinsics& lens,
                     const Pose& X_WC, const CameraFrame& frame, Workers* workers,
                     std::vector<ObjectBox>* boxes);

}  // namespace tera
