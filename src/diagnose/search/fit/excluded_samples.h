#pragma once

#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// A channel of which some samples are excluded from the comparison.
struct ExcludedSamples {
  std::string channel;
  double share = 0;  ///< of the samples that there are
};

/// Excludes the samples that lag behind by masses which the replay does not have
/// (Channel::is_lagging): they become gaps. Afterwards no channel has such samples any more.
/// Returns the channels that had some.
std::vector<ExcludedSamples> ExcludeLaggingSamples(std::vector<ReplayBlock>* blocks);

}  // namespace tera
