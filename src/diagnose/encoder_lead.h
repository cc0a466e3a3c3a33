#pragma once

#include <optional>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Time by which encoders run ahead of the levers that move their joints. No joint moves before its
/// command, so a lead shows that the clocks differ.
///
/// Model   for each joint or track with a lever, the shift of its rate, up to 0.5 s, at which the
///         scenario's predicted rate explains most of it. It is a lead if it exceeds 0.04 s,
///         explains at least half and leaves at most half of the unshifted prediction's residual.
///         The result is the mean, if at least two encoders move and all agree within a quarter.
/// Omits   clocks that drift; a lead of single joints.
std::optional<double> EncoderLead_s(const std::vector<ReplayBlock>& blocks);

}  // namespace tera
