#pragma once

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Lets the heading of a base whose motion was measured be off by one angle, as antennas and maps
/// are: a machine that goes straight then seems to go sideways too.
///
/// Model   a nominal number of the sideways speed: -heading x forward speed as measured, for small
///         angles; half of `tolerance_rad` is one standard deviation, so that no more than the
///         tolerance is let pass (Likelihood). `base` is the block of MakeBaseBlock.
/// Omits   what it changes of the forward speed, a thousandth of it.
void LetHeadingErr(double tolerance_rad, ReplayBlock* base);

}  // namespace tera
