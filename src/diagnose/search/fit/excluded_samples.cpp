#include "diagnose/search/fit/excluded_samples.h"

#include <algorithm>

#include "core/check.h"

namespace tera {
namespace {

/// Turns the channel's lagging samples into gaps. Returns their share of the valid samples.
double ExcludeLaggingSamplesOf(Channel* channel) {
  Mask& valid = channel->measured.valid;
  TERA_CHECK(channel->is_lagging.size() == valid.size(), channel->name);
  const auto before = std::count(valid.begin(), valid.end(), true);
  for (std::size_t k = 0; k < valid.size(); ++k)
    valid[k] = valid[k] != 0 && !channel->is_lagging[k];
  channel->is_lagging.clear();
  const auto after = std::count(valid.begin(), valid.end(), true);
  return before > 0 ? static_cast<double>(before - after) / static_cast<double>(before) : 0;
}

}  // namespace

std::vector<ExcludedSamples> ExcludeLaggingSamples(std::vector<ReplayBlock>* blocks) {
  std::vector<ExcludedSamples> excluded;
  for (ReplayBlock& block : *blocks) {
    for (Channel& channel : block.channels) {
      if (channel.is_lagging.empty()) continue;
      const double share = ExcludeLaggingSamplesOf(&channel);
      if (share > 0) excluded.push_back({channel.name, share});
    }
  }
  return excluded;
}

}  // namespace tera
