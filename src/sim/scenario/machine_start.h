#pragma once

#include "core/config/config_map.h"
#include "core/types/terrain_surface.h"
#include "physics/description/machine_placement.h"

namespace tera {

/// Reads a machine's `start`: position, heading, joint angles (`joints_deg`) and positions of
/// prismatic joints (`joints_m`). A joint is a fault if it is unknown, of the other kind, coupled
/// to another joint, or beyond its limits.
void ReadStart(const ConfigMap& config, MachinePlacement* placement);

/// Sets the machine's height and tilt to fit the ground under its tracks or wheels.
void SetOnGround(const TerrainSurface& ground, MachinePlacement* placement);

}  // namespace tera
