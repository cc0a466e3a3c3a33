#pragma once

#include "sensors/lidar/lidar.h"
#include "sensors/view_field.h"

namespace tera {

/// Model   beams at elevations e_i and n columns: 1 / ((sin e+ - sin e-) 2 pi / n) points per
///         steradian in a revolution, from e- to e+ half way to the beams beside. A surface that
///         returns the share q of the light is seen as far as r10 sqrt(q / 0.1).
///         It has points of glass and none of what lies behind (RayScene).
///         Beams of one elevation alone have no share of the sphere: such a field is flat.
/// Omits   azimuths of single beams: their offsets shift points, and change nothing of how many.
/// Source  radar equation as in Lidar.
ViewField ViewOf(const LidarModel& model, double rate_hz);

}  // namespace tera
