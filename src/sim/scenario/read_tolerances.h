#pragma once

#include <optional>
#include <vector>

#include "core/config/config.h"
#include "core/types/tolerance.h"
#include "physics/description/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// `tolerances:` of a scenario, for all its machines; without a value where it has none.
std::optional<ConfigMap> ReadScenarioTolerances(const ConfigMap& scenario);

/// Reads what the owner of one machine takes as expected: `tolerances:` of the machine's mapping
/// and, over it, the mapping of the machine's name in `scenario_tolerances`. Each is written as the
/// effect of that mechanism would be, with half widths in place of numbers, of any of its
/// parameters:
///
///     tolerances: {boom: {rate_gain: {gain: 0.06}}, imu_boom: {mount_rotation: {roll_deg: 0.5}}}
///
/// Faults, negative and unknown ones included, go to the mappings.
Tolerances ReadMachineTolerances(const ConfigMap& machine,
                                 const std::optional<ConfigMap>& scenario_tolerances,
                                 const std::string& name, const MachineModel& model,
                                 const std::vector<SensorDescription>& sensors);

}  // namespace tera
