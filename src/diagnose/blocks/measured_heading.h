#pragma once

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Allows a constant heading error of a base whose motion is measured, due to antennas or maps. A
/// machine that drives straight then seems to drift sideways.
///
/// Model   a nominal number of the sideways speed: -heading times measured forward speed, for small
///         angles. Half of `tolerance_rad` is one standard deviation, so that the bound is the
///         tolerance (Likelihood). `base` is the block of MakeBaseBlock.
/// Omits   its effect on the forward speed, a thousandth of it.
void LetHeadingErr(double tolerance_rad, ReplayBlock* base);

}  // namespace tera
