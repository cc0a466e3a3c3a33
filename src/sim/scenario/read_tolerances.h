#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "core/types/tolerance.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// `tolerances:` of a scenario, for all its machines; nothing without the key.
std::optional<ConfigMap> ReadScenarioTolerances(const ConfigMap& scenario);

/// Reads the tolerances of one machine: `tolerances:` of the machine's mapping and, over it, the
/// mapping of the machine's name in `scenario_tolerances`. The syntax is that of effects, with half
/// widths as the values of any parameters:
///
///     tolerances: {boom: {rate_gain: {gain: 0.06}}, imu_boom: {mount_rotation: {roll_deg: 0.5}}}
///
/// Faults, including negative and unknown values, go to the mappings.
Tolerances ReadMachineTolerances(const ConfigMap& machine,
                                 const std::optional<ConfigMap>& scenario_tolerances,
                                 const std::string& name, const MachineModel& model,
                                 const std::vector<SensorDescription>& sensors);

}  // namespace tera
