#pragma once

#include "core/config/config_map.h"
#include "core/types/terrain_surface.h"
#include "physics/description/machine_placement.h"

namespace tera {

/// Reads a machine's `start`: position and heading, joint angles (`joints_deg`) and, for sliding
/// joints, positions (`joints_m`). A joint is a fault if it is unknown, of the other kind, a
/// follower, or beyond its limits.
void ReadStart(const ConfigMap& config, MachinePlacement* placement);

/// Sets height and tilt of a machine from the ground under its tracks or wheels.
void SetOnGround(const TerrainSurface& ground, MachinePlacement* placement);

}  // namespace tera
