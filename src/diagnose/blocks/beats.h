#pragma once

#include <vector>

namespace tera {

/// Events that recur at t = (k + phase) period, with integer k.
struct Beat {
  double period_s = 0;
  double phase = 0;     ///< 0 to 1
  double strength = 0;  ///< 0 to 1: length of the mean phasor of the changes
};

struct BeatOptions {
  double shortest_s = 0.04, longest_s = 0.6;
  std::size_t most = 3;
};

/// Finds the strongest periods in the times at which a measured quantity changes. A quantity that a
/// program sets periodically changes at such times.
///
/// Model   Rayleigh periodogram of the absolute differences between samples, minus their mean, over
///         the minute with most change. The highest peaks are refined over the whole recording.
/// Omits   Gradual changes: the phase is that of the start of a change only if the change is
///         sudden.
/// Source  Mardia and Jupp 2000, "Directional statistics", ch. 6 (Rayleigh's statistic).
///
/// `t_s` ascends. Differences over gaps of more than two median periods are ignored.
std::vector<Beat> BeatsOf(const std::vector<double>& t_s, const std::vector<double>& value,
                          const BeatOptions& options);

}  // namespace tera
