#pragma once

#include <optional>

#include "diagnose/replay/effort_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The block of one joint's drive: its measured effort against what its measured motion needs.
///
/// Model   candidates are the friction of load_friction and its offset, with sizes by the largest
///         effort and rate of the log. `asymmetric_friction` is looked for in one direction at a
///         time, for more in both is no asymmetry. Flexible regressor: constant, sign and magnitude
///         of the rate and their powers, all by position, and the acceleration. Nominal numbers:
///         mass or inertia, and weight, known to 3 %. Manoeuvres are cut by the rate.
/// Omits   friction that grows with the load; `payload`, which is a wrong mass.
///
/// None where there is hardly a sample.
std::optional<ReplayBlock> MakeEffortBlock(const MachineModel& model, EffortLog log);

}  // namespace tera
