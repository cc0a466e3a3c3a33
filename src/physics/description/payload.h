#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Adds what the effect `payload` of each joint hangs on the link that the joint moves.
///
/// Frames  B of that link.
/// Model   A point mass, part of the link from the start: mass, centre of mass and inertia of the
///         two together (parallel axis theorem).
void AddPayloads(MachineModel* model);

}  // namespace tera
