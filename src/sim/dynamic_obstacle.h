#pragma once

#include "physics/description/machine_placement.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// An obstacle that forces can move, in the form that physics and soil understand: a machine with
/// one link and no joints, levers or running gear.
///
/// Frames  the link's frame B is that of the obstacle's mesh.
/// Model   the inertia is that of its boxes at uniform density, about their common centre. The
///         centre of mass is the given one.
///         The ground supports its corners and points along its edges, at most half a metre apart.
///         It supports the structure of machines in the same way (HullContact). The obstacle sinks
///         by some millimetres and slides beyond Coulomb friction. Bullet resolves its contacts
///         with machines, obstacles and walls.
/// Omits   ruts and prints in the ground; rolling of round shapes, since boxes are their shape;
///         tracks and wheels that climb it, since they collide with it.
MachinePlacement PlacementOf(const ScenarioObstacle& obstacle, const Pose& X_WB);

}  // namespace tera
