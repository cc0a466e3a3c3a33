#pragma once

#include <optional>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// By how much encoders run ahead of the levers that move their joints, in seconds: nothing moves
/// before it is commanded to, so that the clocks differ.
///
/// Model   of each joint or track that a lever drives: the shift of its rate, up to 0.5 s, at which
///         it is most in proportion to the rate that the scenario predicts, if that is 0.03 s or
///         more and leaves at most half of what the unshifted prediction leaves unexplained. Given
///         where two are moved at least and all of them agree to a quarter; their mean.
/// Omits   clocks that drift; a lead that single joints have.
std::optional<double> EncoderLead_s(const std::vector<ReplayBlock>& blocks);

}  // namespace tera
