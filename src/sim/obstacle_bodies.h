#pragma once

#include <vector>

#include "render/scene.h"
#include "sim/scenario/scenario.h"

/// Scene bodies of an obstacle, in this order: the obstacle, its bed, the bed's gate (if it has a
/// mesh of its own), wheels, limbs.

namespace tera {

/// Appends the poses of the bodies at `t_ns`, for an obstacle at `X_WB`.
void AppendObstaclePoses(const ScenarioObstacle& obstacle, const Pose& X_WB, TimeNs t_ns,
                         std::vector<Pose>* poses);

/// Extends the box of an obstacle's instance to contain a limb's mesh at every angle of its swing.
void GrowBoxByLimb(const ScenarioObstacle& obstacle, std::size_t limb, const Mesh& mesh,
                   SceneInstance* instance);

}  // namespace tera
