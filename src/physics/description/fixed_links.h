#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Gives each moving link without mass the mass of the links that fixed joints attach to it, over
/// any number of fixed joints. The links form a single rigid body, so the motion is unchanged. The
/// attached links then have no mass; their poses and their other contents stay. A root bolted to
/// the world needs no mass.
///
/// Frames  C the link that receives the mass, B a link fixed to it.
/// Model   masses and first moments add up; inertias about the common centre by the parallel-axis
///         theorem.
void GatherFixedMasses(MachineModel* model);

}  // namespace tera
