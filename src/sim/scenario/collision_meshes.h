#pragma once

#include "core/config/config.h"
#include "physics/description/machine.h"

namespace tera {

/// Replaces the collision meshes of a machine's links by their bounding boxes in the mesh's own
/// axes, at least 1 mm thick. An unreadable file is a fault of `urdf` in `config`.
void SetCollisionMeshes(const ConfigMap& config, MachineModel* model);

}  // namespace tera
