#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Adds the effect `payload` of each joint to the link that the joint moves.
///
/// Frames  B of that link.
/// Model   a point mass fixed to the link from the start: mass, centre of mass and inertia of both
///         (parallel axis theorem).
void AddPayloads(MachineModel* model);

}  // namespace tera
