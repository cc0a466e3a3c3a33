#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Adds the effect `payload` of each joint to the link that the joint moves.
///
/// Frames  B of that link.
/// Model   A point mass fixed to the link from the start. It changes mass, centre of mass and
///         inertia (parallel-axis theorem).
void AddPayloads(MachineModel* model);

}  // namespace tera
