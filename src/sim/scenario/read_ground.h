#pragma once

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "soil/site/site.h"

namespace tera {

/// Reads `ground` of a scenario's machine, whose effects `model` has already, and lays down how it
/// meets the soil. Faults go to `config`, the machine's entry: another word, a machine without left
/// and right running gear; and to effects of tracks that the choice has no place for.
void ReadGround(const ConfigMap& config, MachineModel* model);

/// Reports a terrain_height among the effects of `model`, the machine of the entry `config`, that
/// lies wholly beyond `site`.
void CheckRaisedGround(const ConfigMap& config, const MachineModel& model,
                       const TerrainSurface& site);

/// Raises the ground as terrain_height among the effects of `model` says.
void RaiseGround(const MachineModel& model, Site* site);

}  // namespace tera
