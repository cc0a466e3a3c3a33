#pragma once

#include <optional>

#include "diagnose/replay/effort_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Makes the block of one joint's drive. The block compares the measured effort with the effort
/// that the measured motion needs.
///
/// Model   Candidates are friction and offset mechanisms of the slot load_friction. The largest
///         effort and rate of the log set their sizes. `asymmetric_friction` is searched for each
///         direction separately, because an increase in both directions is symmetric. The flexible
///         regressor has a constant, the rate's sign, magnitude and powers, their products with
///         position, and the acceleration. Nominal numbers: inertial effort and weight, each with a
///         standard deviation of 3 %. Manoeuvres are separated by the rate.
/// Omits   Friction that grows with load; `payload`, which acts like a wrong mass.
///
/// Returns nothing with too few samples.
std::optional<ReplayBlock> MakeEffortBlock(const MachineModel& model, EffortLog log);

}  // namespace tera
