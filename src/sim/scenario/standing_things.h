#pragma once

#include <vector>

#include "core/config/config.h"
#include "sim/scenario/footprint.h"

namespace tera {

/// Occupied squares of a scenario's ground without its draws: about each machine start (`clear_m`
/// to each side), each obstacle and each pile's foot.
///
/// Model   places as written, or as `drawn` has them; the scenario is not read.
/// Omits   places from --set, paths of obstacles.
std::vector<Footprint> StandingThings(const ConfigMap& scenario,
                                      const std::vector<Config::GivenValue>& drawn, double clear_m);

}  // namespace tera
