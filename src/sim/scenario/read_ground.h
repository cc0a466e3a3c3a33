#pragma once

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "soil/site/site.h"

namespace tera {

/// Reads `ground` of a machine in a scenario and sets its soil contact model. The effects must
/// already be in `model`. Faults go to `config`: an unknown word, a machine without left and right
/// running gear, and track effects that the chosen model does not support.
void ReadGround(const ConfigMap& config, MachineModel* model);

/// Reports terrain_height effects of `model` that lie completely off `site`. `config` is the
/// machine's entry.
void CheckRaisedGround(const ConfigMap& config, const MachineModel& model,
                       const TerrainSurface& site);

/// Reports a `cell_m` of the terrain that is wider than a shoe or wheel of `model`, which would
/// then stand on single points. The default is fine enough. Pavement is exempt because it does not
/// yield.
void CheckCells(const ConfigMap& terrain, const MachineModel& model, const Site& site);

/// Raises the ground of `site` by the model's terrain_height effects.
void RaiseGround(const MachineModel& model, Site* site);

}  // namespace tera
