#pragma once

#include "core/config/config.h"
#include "physics/description/machine.h"

namespace tera {

/// Turns the collision meshes of a machine's links into boxes: each the box around its mesh along
/// the axes of the mesh's own frame, 1 mm thick at least. A file that cannot be read is a fault of
/// `urdf` in `config`.
void SetCollisionMeshes(const ConfigMap& config, MachineModel* model);

}  // namespace tera
