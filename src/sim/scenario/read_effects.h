#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// The scenario's mapping `effects:`, which is for all machines. Empty without that key.
std::optional<ConfigMap> ReadScenarioEffects(const ConfigMap& scenario);

/// Reads the effects of one machine into its model and sensors. Two mappings give them: `effects:`
/// of the machine, and with higher priority the mapping with the machine's name in
/// `scenario_effects`. Keys are names of targets: joints, running gears, pumps, sensors, one axis
/// of a set of encoders ("encoders/boom"), or `base` for the motion of the whole machine. A fault
/// is reported at its own mapping. The combined effects are checked only if the rest of the
/// machine's description is valid (`sound`).
void ReadMachineEffects(const ConfigMap& machine, const std::optional<ConfigMap>& scenario_effects,
                        const std::string& name, bool sound, MachineModel* model,
                        std::vector<SensorDescription>* sensors);

}  // namespace tera
