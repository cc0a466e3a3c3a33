#pragma once

#include <string>
#include <vector>

#include "diagnose/search/structure/baselines.h"

namespace tera {

/// Answers of the baseline methods for one block, and the unchanged replay's RMSE on FINAL.
struct BlockBaselines {
  std::vector<std::string> channels;
  std::vector<double> rmse_as_it_is;  ///< one for each channel
  std::vector<BaselineAnswer> answers;
};

/// baselines.json: `{"as_it_is": {CHANNEL: RMSE}, "methods": [{"method", "gives_findings",
/// "gives_names", "found", "names": [{"mechanism", "target"}], "rmse": {CHANNEL: RMSE}}]}`, over
/// all blocks.
std::string BaselinesJson(const std::vector<BlockBaselines>& blocks);

}  // namespace tera
