#pragma once

#include "core/config/config.h"
#include "render/scene.h"

namespace tera {

/// Wind, rain, snow and dust of the key `environment`; rain takes its part of the visibility of
/// `environment`, whose sky is known. Weather that contradicts itself is a fault.
void ReadWeather(const ConfigMap& config, Environment* environment);

}  // namespace tera
