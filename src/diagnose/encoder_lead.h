#pragma once

#include <optional>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The time by which encoders run ahead of the levers that move their joints. Nothing moves before
/// it is commanded to, so that a lead shows that the clocks differ.
///
/// Model   for each joint or track that a lever drives, the shift of its rate, up to 0.5 s, at
///         which the rate that the scenario predicts explains most of it. It is a lead if it is
///         0.04 s or more and leaves at most half of what the unshifted prediction leaves
///         unexplained. The result is the mean, where at least two encoders move and all of them
///         agree to a quarter.
/// Omits   clocks that drift; a lead that single joints have.
std::optional<double> EncoderLead_s(const std::vector<ReplayBlock>& blocks);

}  // namespace tera
