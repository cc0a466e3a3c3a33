#pragma once

#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// A channel with samples excluded from the comparison.
struct ExcludedSamples {
  std::string channel;
  double share = 0;  ///< share of the valid samples
};

/// Turns samples that lag behind by inertia absent from the replay (Channel::is_lagging) into gaps,
/// and clears the flags. Returns the channels concerned.
std::vector<ExcludedSamples> ExcludeLaggingSamples(std::vector<ReplayBlock>* blocks);

}  // namespace tera
