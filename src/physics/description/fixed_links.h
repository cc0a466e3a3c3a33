#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Gives each moving link without mass the masses of the links attached by fixed joints, over any
/// number of fixed joints. These links form a single rigid body, so the motion is unchanged. The
/// attached links then have no mass; their poses and other contents stay. A root bolted to the
/// world needs no mass.
///
/// Frames  C the link that receives the mass, B a link fixed to it.
/// Model   Masses and first moments add up; inertias about the common centre follow the
///         parallel-axis theorem.
void GatherFixedMasses(MachineModel* model);

}  // namespace tera
