#pragma once

#include <vector>

#include "core/types/measurement.h"
#include "core/workers.h"
#include "render/gl/camera_intrinsics.h"
#include "render/scene.h"

namespace tera {

/// Adds the amodal box and the key points to each box. An amodal box ignores occlusion and the
/// image border.
///
/// Model   the amodal box bounds the projections of all triangle corners of the object, clipped at
///         near_m. Where a distorting lens has no pixels, its projection continues as a pinhole
///         beyond the rim of the image. An angular lens shows only its field. Truncation is the
///         fraction of the box outside the image.
///         A key point is visible if the nearest pixel shows its object and that surface lies at
///         most the key point's radius in front of it.
void AddWholeObjects(const SceneModel& model, const SceneState& state, const CameraIntrinsics& lens,
                     const Pose& X_WC, const CameraFrame& frame, Workers* workers,
                     std::vector<ObjectBox>* boxes);

}  // namespace tera
