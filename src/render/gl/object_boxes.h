#pragma once

#include <cstdint>
#include <vector>

#include "core/types/measurement.h"
#include "core/workers.h"
#include "render/scene.h"

namespace tera {

/// Pixel count of each instance. A whole counts the pixels of its parts.
std::vector<std::int64_t> CountPixels(const Image<std::uint16_t>& instance,
                                      const SceneModel& model);

/// Boxes around the visible pixels of each visible instance, by increasing instance, with their 3D
/// boxes. `visibility` stays 0. A whole is visible if at least one part is. The 3D box of a whole
/// encloses its parts, along the axes of its body.
std::vector<ObjectBox> FindBoxes(const SceneModel& model, const SceneState& state, const Pose& X_WC,
                                 const Image<std::uint16_t>& instance, Workers* workers);

}  // namespace tera
