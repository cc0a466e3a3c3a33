#pragma once

#include <optional>

#include "diagnose/replay/effort_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Block of one joint's drive: its measured effort against the effort that its measured motion
/// needs.
///
/// Model   candidates are the friction and offset of load_friction, with sizes by the log's largest
///         effort and rate. `asymmetric_friction` is searched in one direction at a time, since
///         more in both is no asymmetry. Flexible regressor: constant, sign, magnitude and powers
///         of the rate, all by position, and the acceleration. Nominal numbers: mass or inertia,
///         and weight, known to 3 %. The rate separates the manoeuvres.
/// Omits   friction that grows with load; `payload`, which is a wrong mass.
///
/// None with too few samples.
std::optional<ReplayBlock> MakeEffortBlock(const MachineModel& model, EffortLog log);

}  // namespace tera
