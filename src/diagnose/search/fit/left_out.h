#pragma once

#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// A channel some of whose samples do not count.
struct LeftOut {
  std::string channel;
  double share = 0;  ///< of the samples that there are
};

/// Parts the samples that lag by masses that the replay does not have (Channel::lags) from those
/// that count. Once it is done no channel has such samples any more. Returns the channels that had
/// some.
std::vector<LeftOut> LeaveOutLags(std::vector<ReplayBlock>* blocks);

}  // namespace tera
