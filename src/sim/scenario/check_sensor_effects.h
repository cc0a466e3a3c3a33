#pragma once

#include <vector>

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// Reports effects that would change nothing of what a sensor of this machine measures: errors of a
/// depth that a camera does not give, of metres where an axis turns, of a pair of antennas where
/// there is none, and the like. `effects` is the machine's mapping of targets, from which `sensors`
/// have theirs.
void CheckSensorEffects(const ConfigMap& effects, const MachineModel& model,
                        const std::vector<SensorDescription>& sensors);

}  // namespace tera
