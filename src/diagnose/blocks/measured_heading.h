#pragma once

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Adds a constant heading error to the base's block, as a nominal number. Antennas or maps cause
/// such an error. A machine that drives straight then appears to move sideways.
///
/// Model   The change of the sideways speed is -heading times measured forward speed, for small
///         angles. Half of `tolerance_rad` is one standard deviation, because Likelihood bounds
///         nuisances at two. `base` is the block of MakeBaseBlock.
/// Omits   The effect on the forward speed, about a thousandth of it.
void LetHeadingErr(double tolerance_rad, ReplayBlock* base);

}  // namespace tera
