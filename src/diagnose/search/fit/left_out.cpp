#include "diagnose/search/fit/left_out.h"

#include <algorithm>

#include "core/check.h"

namespace tera {
namespace {

/// The share of a channel's samples that it takes out.
double LeaveOutLagsOf(Channel* channel) {
  Mask& valid = channel->measured.valid;
  TERA_CHECK(channel->lags.size() == valid.size(), channel->name);
  const auto before = std::count(valid.begin(), valid.end(), true);
  for (std::size_t k = 0; k < valid.size(); ++k) valid[k] = valid[k] != 0 && !channel->lags[k];
  channel->lags.clear();
  const auto after = std::count(valid.begin(), valid.end(), true);
  return before > 0 ? static_cast<double>(before - after) / static_cast<double>(before) : 0;
}

}  // namespace

std::vector<LeftOut> LeaveOutLags(std::vector<ReplayBlock>* blocks) {
  std::vector<LeftOut> left_out;
  for (ReplayBlock& block : *blocks) {
    for (Channel& channel : block.channels) {
      if (channel.lags.empty()) continue;
      const double share = LeaveOutLagsOf(&channel);
      if (share > 0) left_out.push_back({channel.name, share});
    }
  }
  return left_out;
}

}  // namespace tera
