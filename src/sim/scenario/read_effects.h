#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// `effects:` of a scenario, for all its machines; nothing without the key.
std::optional<ConfigMap> ReadScenarioEffects(const ConfigMap& scenario);

/// Reads the effects of one machine into its model and its sensors: `effects:` of the machine's
/// mapping and, over it, the mapping of the machine's name in `scenario_effects`. Targets are the
/// names of joints, running gears, pumps and sensors, of one axis of a set of encoders
/// "encoders/boom", and `base` for the motion of the whole machine. Each fault goes to its own
/// mapping. The combined effects are checked only if the machine's own description is `sound`.
void ReadMachineEffects(const ConfigMap& machine, const std::optional<ConfigMap>& scenario_effects,
                        const std::string& name, bool sound, MachineModel* model,
                        std::vector<SensorDescription>* sensors);

}  // namespace tera
