#pragma once

#include <string>
#include <vector>

#include "diagnose/search/structure/baselines.h"

namespace tera {

/// Simpler methods' answers to one block, and what the replay as it is leaves of FINAL.
struct BlockBaselines {
  std::vector<std::string> channels;
  std::vector<double> rmse_as_it_is;  ///< one a channel
  std::vector<BaselineAnswer> answers;
};

/// baselines.json: `{"as_it_is": {CHANNEL: RMSE}, "methods": [{"method", "gives_findings",
/// "gives_names", "found", "names": [{"mechanism", "target"}], "rmse": {CHANNEL: RMSE}}]}`, over
/// all blocks.
std::string BaselinesJson(const std::vector<BlockBaselines>& blocks);

}  // namespace tera
