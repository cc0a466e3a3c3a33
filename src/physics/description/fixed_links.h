#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Where a link that moves has no mass, gives it that of the links fixed to it, over any number of
/// fixed joints: what is fixed together is one body, so the motion is the same. Those links then
/// have none, and stay where they are with all else that is on them. A root that is bolted to the
/// world needs none.
///
/// Frames  C the link that gets the mass, B one fixed to it.
/// Model   mass and first moment add up; inertias about the common centre by the parallel-axis
///         theorem.
void GatherFixedMasses(MachineModel* model);

}  // namespace tera
