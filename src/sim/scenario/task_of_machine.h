#pragma once

#include <optional>

#include "core/config/config_map.h"
#include "core/types/terrain_surface.h"
#include "physics/description/machine_placement.h"
#include "sim/operators/operator_plan.h"
#include "sim/task/task.h"

namespace tera {

/// Gives the scenario's task to a machine whose operator digs to a design. Reports the reason at
/// the task's or machine's mapping if the machine cannot do it: no task, no trench, a floor
/// narrower than its bucket or beyond its reach, a start off the trench's line.
void GiveTask(const std::optional<ConfigMap>& task_config, const ConfigMap& machine_config,
              const std::optional<Task>& task, const TerrainSurface& ground,
              const MachinePlacement& placement, OperatorPlan* driver);

}  // namespace tera
