#pragma once

#include <cstdint>
#include <vector>

#include "core/types/measurement.h"
#include "core/workers.h"
#include "render/scene.h"

namespace tera {

/// Pixel count of each instance; a whole's count is the sum over its parts.
std::vector<std::int64_t> CountPixels(const Image<std::uint16_t>& instance,
                                      const SceneModel& model);

/// Boxes around the visible pixels of each visible instance, in order of instance, with their 3D
/// boxes. `visibility` stays 0. A whole is visible if a part is. Its 3D box encloses its parts,
/// along the axes of its body.
std::vector<ObjectBox> FindBoxes(const SceneModel& model, const SceneState& state, const Pose& X_WC,
                                 const Image<std::uint16_t>& instance, Workers* workers);

}  // namespace tera
