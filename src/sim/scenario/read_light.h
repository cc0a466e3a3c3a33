#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "render/scene.h"
#include "sim/scenario/scenario_lamp.h"
#include "soil/soil.h"

namespace tera {

/// Reads the key `environment`: sun, sky and air.
Environment ReadEnvironment(const ConfigMap& config, const SiteOrigin& origin);

/// Returns the scenario's machine with this name, or null.
using MachineOfName = std::function<const MachineModel*(const std::string& name)>;

/// Reads the key `lamps` of a scenario.
std::vector<ScenarioLamp> ReadLamps(const ConfigMap& config, const MachineOfName& machine_of);

}  // namespace tera
