#pragma once

#include <cstdint>
#include <vector>

#include "core/types/measurement.h"
#include "core/workers.h"
#include "render/scene.h"

namespace tera {

/// Pixels of each instance in an image, those of a whole being those of its parts.
std::vector<std::int64_t> CountPixels(const Image<std::uint16_t>& instance,
                                      const SceneModel& model);

/// Boxes around the visible pixels of each visible instance, in order of instance, with their 3D
/// boxes; `visibility` is left 0. A whole is visible where a part of it is; its 3D box holds all
/// its parts as they stand, along the axes of its body.
std::vector<ObjectBox> FindBoxes(const SceneModel& model, const SceneState& state, const Pose& X_WC,
                                 const Image<std::uint16_t>& instance, Workers* workers);

}  // namespace tera
