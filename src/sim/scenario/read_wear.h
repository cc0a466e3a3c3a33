#pragma once

#include "core/config/config.h"
#include "render/wear.h"

namespace tera {

/// The mapping `wear` of a scenario, a machine or an obstacle: what it leaves out is as in
/// `of_all`.
Wear ReadWear(const ConfigMap& config, const Wear& of_all);

}  // namespace tera
