#pragma once

#include "core/config/config_map.h"
#include "core/types/terrain_surface.h"
#include "physics/description/machine_placement.h"

namespace tera {

/// Where a machine begins, by its key `start`: place and heading on the level, angles of its joints
/// (`joints_deg`) and, of those that slide, ways (`joints_m`). A joint that there is not, that
/// moves otherwise than its key says, follows another or would be beyond its limits is a fault.
void ReadStart(const ConfigMap& config, MachinePlacement* placement);

/// Sets a machine down at its place: height and tilt of the ground under its tracks or wheels.
void SetOnGround(const TerrainSurface& ground, MachinePlacement* placement);

}  // namespace tera
