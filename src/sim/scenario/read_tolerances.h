#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "core/types/tolerance.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// The scenario's mapping `tolerances:`, which is for all machines. Empty without that key.
std::optional<ConfigMap> ReadScenarioTolerances(const ConfigMap& scenario);

/// Reads the tolerances of one machine. Two mappings give them: `tolerances:` of the machine, and
/// with higher priority the mapping with the machine's name in `scenario_tolerances`. The syntax is
/// that of effects; values are half widths of the tolerance, for any parameter:
///
/// tolerances: {boom: {rate_gain: {gain: 0.06}}, imu_boom: {mount_rotation: {roll_deg: 0.5}}}
///
/// Faults, including negative and unknown values, go to the mappings.
Tolerances ReadMachineTolerances(const ConfigMap& machine,
                                 const std::optional<ConfigMap>& scenario_tolerances,
                                 const std::string& name, const MachineModel& model,
                                 const std::vector<SensorDescription>& sensors);

}  // namespace tera
