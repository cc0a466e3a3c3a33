#include "diagnose/search/fit/noise_level.h"

#include <algorithm>
#include <cmath>

#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kMostRestCommand = 0.02;  ///< |command| up to this is rest
constexpr double kDecay_s = 1.5;           ///< time from the last command to rest
constexpr double kLeastRest_s = 2;         ///< shorter rest does not determine the noise

/// Samples at rest, after the motion of the last command has decayed.
Mask AtRest(const ReplayBlock& block) {
  Mask mask(block.samples(), 0);
  const auto decay = static_cast<std::size_t>(std::lround(kDecay_s / block.period_s()));
  std::size_t still = 0;
  for (std::size_t k = 0; k < mask.size(); ++k) {
    const bool rests = std::all_of(
        block.commands.begin(), block.commands.end(),
        [&](const Series& command) { return std::abs(command.value[k]) <= kMostRestCommand; });
    still = rests ? still + 1 : 0;
    mask[k] = still > decay;
  }
  return mask;
}

}  // namespace

NoiseLevel NoiseLevelOf(const ReplayBlock& block, std::size_t channel, const Series& residual,
                        const Mask& mask) {
  NoiseLevel level;
  const Mask usable = Both(mask, Both(residual.valid, block.channels[channel].measured.valid));
  const std::vector<double> rest = ValidValues(Restricted(residual, Both(usable, AtRest(block))));
  const double rest_s = static_cast<double>(rest.size()) * block.period_s();
  if (block.rest_shows_noise && rest_s >= kLeastRest_s) {
    double sum = 0;
    for (const double e : rest) sum += e * e;
    level.at_rest = std::sqrt(sum / static_cast<double>(rest.size()));
  }
  std::vector<double> differences;
  for (const Segment& segment : SegmentsOf(usable, 4)) {
    for (std::size_t k = segment.begin + 3; k < segment.end; ++k) {
      const double* e = &residual.value[k];
      differences.push_back(e[0] - 3 * e[-1] + 3 * e[-2] - e[-3]);
    }
  }
  if (!differences.empty()) level.differences = RobustScale(differences) / std::sqrt(20.0);
  return level;
}

}  // namespace tera
