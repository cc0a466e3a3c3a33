#pragma once

#include <vector>

#include "core/config/config.h"
#include "sim/scenario/footprint.h"

namespace tera {

/// What a scenario has on its ground before anything is drawn: a square about each place where a
/// machine starts (`clear_m` to each side), about each obstacle and about each pile's foot.
///
/// Model   places as they are written, or as `drawn` has them; without reading the scenario.
/// Omits   places that --set gives, paths of obstacles.
std::vector<Footprint> StandingThings(const ConfigMap& scenario,
                                      const std::vector<Config::GivenValue>& drawn, double clear_m);

}  // namespace tera
