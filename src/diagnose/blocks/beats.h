#pragma once

#include <vector>

namespace tera {

/// A period of recurring events, at t = (k + phase) period.
struct Beat {
  double period_s = 0;
  double phase = 0;     ///< 0 to 1
  double strength = 0;  ///< share of the changes in phase, 0 to 1
};

struct BeatOptions {
  double shortest_s = 0.04, longest_s = 0.6;
  std::size_t most = 3;
};

/// The strongest periods in the times at which a measured quantity changes. A quantity set
/// periodically changes so.
///
/// Model   Rayleigh periodogram of the absolute differences between samples, minus their mean, over
///         the minute with most change. Its highest peaks are refined over the whole recording.
/// Omits   gradual changes: the phase is that of a change's start only if it is sudden.
/// Source  Mardia and Jupp 2000, "Directional statistics", ch. 6 (Rayleigh's statistic).
///
/// `t_s` ascends. Differences over gaps of more than two median periods are ignored.
std::vector<Beat> BeatsOf(const std::vector<double>& t_s, const std::vector<double>& value,
                          const BeatOptions& options);

}  // namespace tera
