#pragma once

#include <vector>

namespace tera {

/// A period at which something happens repeatedly, at t = (k + phase) period.
struct Beat {
  double period_s = 0;
  double phase = 0;     ///< 0 to 1
  double strength = 0;  ///< share of the changes that are in phase, 0 to 1
};

struct BeatOptions {
  double shortest_s = 0.04, longest_s = 0.6;
  std::size_t most = 3;
};

/// The strongest beats in the times at which a measured quantity changes, as of a quantity that is
/// set once a period.
///
/// Model   Rayleigh periodogram of the absolute differences between samples, less their mean, over
///         the minute with most change; its highest peaks, each refined over the whole recording.
/// Omits   what makes a change last: the phase is that of its start only where it is sudden.
/// Source  Mardia and Jupp 2000, "Directional statistics", ch. 6 (Rayleigh's statistic).
///
/// `t_s` rises. A difference over a gap of more than two median periods is left out.
std::vector<Beat> BeatsOf(const std::vector<double>& t_s, const std::vector<double>& value,
                          const BeatOptions& options);

}  // namespace tera
