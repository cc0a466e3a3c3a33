#pragma once

#include "physics/description/machine_placement.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// An obstacle that moves by forces, as the physics and the soil see it: a machine of one link
/// without joints, levers and running gear.
///
/// Frames  the link's frame B is that of the obstacle's mesh.
/// Model   Inertia of its boxes at a uniform density about their common centre; the centre of mass
///         as given.
///         The ground supports its corners, and points along its edges at most half a metre apart,
///         like the structure of machines (HullContact). It sinks by some millimetres, and slides
///         beyond Coulomb friction. Bullet resolves its contacts with machines, obstacles and
///         walls.
/// Omits   ruts and prints in the ground, rolling of round shapes (boxes are their shape),
///         gear that climbs it: tracks and wheels collide with it.
MachinePlacement PlacementOf(const ScenarioObstacle& obstacle, const Pose& X_WB);

}  // namespace tera
