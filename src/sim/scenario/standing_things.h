#pragma once

#include <vector>

#include "core/config/config.h"
#include "sim/scenario/footprint.h"

namespace tera {

/// Squares of ground that a scenario occupies before a site is drawn: around each start of a
/// machine (`clear_m` to each side), each obstacle and the foot of each pile.
///
/// Model   positions as written in the scenario, or as in `drawn`. The files that the scenario
///         names are not read.
/// Omits   positions from --set, paths of obstacles.
std::vector<Footprint> StandingThings(const ConfigMap& scenario,
                                      const std::vector<Config::GivenValue>& drawn, double clear_m);

}  // namespace tera
