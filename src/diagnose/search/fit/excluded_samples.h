#pragma once

#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

struct ExcludedSamples {
  std::string channel;
  double share = 0;  ///< share of the valid samples
};

/// Turns samples that lag because of inertia missing in the replay (Channel::is_lagging) into gaps,
/// and clears the flags. Returns the channels that lost samples.
std::vector<ExcludedSamples> ExcludeLaggingSamples(std::vector<ReplayBlock>* blocks);

}  // namespace tera
