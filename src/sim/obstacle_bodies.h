#pragma once

#include <vector>

#include "render/scene.h"
#include "sim/scenario/scenario.h"

/// The bodies of an obstacle in a scene, in order: itself, its bed and the bed's gate if separate,
/// its wheels, its limbs.

namespace tera {

/// Appends the bodies' poses at `t_ns` for an obstacle at `X_WB`.
void AppendObstaclePoses(const ScenarioObstacle& obstacle, const Pose& X_WB, TimeNs t_ns,
                         std::vector<Pose>* poses);

/// Widens the box of an obstacle's instance to hold a limb's mesh in its whole swing.
void GrowBoxByLimb(const ScenarioObstacle& obstacle, std::size_t limb, const Mesh& mesh,
                   SceneInstance* instance);

}  // namespace tera
