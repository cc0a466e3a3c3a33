#pragma once

#include "core/config/config.h"
#include "render/scene.h"

namespace tera {

/// Reads wind, rain, snow and dust of the key `environment`. Rain reduces the visibility of
/// `environment`, whose sky must already be read. Contradictory weather is a fault.
void ReadWeather(const ConfigMap& config, Environment* environment);

}  // namespace tera
