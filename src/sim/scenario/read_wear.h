#pragma once

#include "core/config/config.h"
#include "render/wear.h"

namespace tera {

/// Reads the mapping `wear` of a scenario, a machine or an obstacle. `of_all` contains the
/// defaults.
Wear ReadWear(const ConfigMap& config, const Wear& of_all);

}  // namespace tera
