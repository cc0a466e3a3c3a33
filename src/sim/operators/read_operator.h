#pragma once

#include <memory>

#include "core/config/config.h"
#include "physics/description/machine.h"
#include "sim/operators/operator.h"

namespace tera {

/// Reads a machine's `operator:` mapping. `type` is one of idle, lever_replay, twist_replay,
/// waypoints, dig_cycle, random_levers. Faults (a joint or lever the machine lacks, an unreadable
/// file) go to `config`.
std::unique_ptr<Operator> ReadOperator(const ConfigMap& config, const MachineModel& model,
                                       const OperatorStream& stream);

}  // namespace tera
