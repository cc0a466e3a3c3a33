#pragma once

#include <vector>

namespace tera {

/// A period at which something happens again and again, at t = (k + phase) period.
struct Beat {
  double period_s = 0;
  double phase = 0;     ///< 0 to 1
  double strength = 0;  ///< share of the changes that keep to it, 0 to 1
};

struct BeatOptions {
  double shortest_s = 0.04, longest_s = 0.6;
  std::size_t most = 3;
};

/// The strongest beats in the times at which a measured quantity changes, as one that is told to
/// change once a period does.
///
/// Model   Rayleigh periodogram of the absolute differences between samples, less their mean, over
///         the liveliest minute; its highest peaks, each refined over all of the recording.
/// Omits   what makes a change last: the phase is that of its beginning only where it is sudden.
/// Source  Mardia and Jupp 2000, "Directional statistics", ch. 6 (Rayleigh's statistic).
///
/// `t_s` rises; a difference over a gap of more than two of the median periods is left out.
std::vector<Beat> BeatsOf(const std::vector<double>& t_s, const std::vector<double>& value,
                          const BeatOptions& options);

}  // namespace tera
