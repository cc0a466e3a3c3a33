#pragma once

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "soil/site/site.h"

namespace tera {

/// Reads `ground` of a scenario's machine and sets its soil contact model. `model` must already
/// have its effects. Faults go to `config`, the machine's entry: an unknown word, a machine without
/// left and right running gear, and track effects that the choice does not support.
void ReadGround(const ConfigMap& config, MachineModel* model);

/// Reports terrain_height effects of `model`, the machine of the entry `config`, that lie wholly
/// off `site`.
void CheckRaisedGround(const ConfigMap& config, const MachineModel& model,
                       const TerrainSurface& site);

/// Reports `cell_m` of the terrain entry that is wider than a shoe or wheel of `model`, in cells of
/// which it would stand on points. The default is fine enough, and pavement yields nowhere.
void CheckCells(const ConfigMap& terrain, const MachineModel& model, const Site& site);

/// Raises the ground by the model's terrain_height effects.
void RaiseGround(const MachineModel& model, Site* site);

}  // namespace tera
