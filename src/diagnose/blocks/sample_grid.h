#pragma once

#include <cstddef>
#include <vector>

#include "core/time.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// A uniform grid under samples that come almost evenly.
///
/// Model   its period is the median of the samples' steps; a sample stands at the place nearest to
///         its time, of two at one place the first one.
struct SampleGrid {
  double period_s = 0;
  std::size_t size = 0;
  std::vector<std::size_t> place;  ///< of each sample

  /// Two samples at least, times that rise. Throws InputError where most of the grid would be
  /// empty: samples in bursts, or a gap far longer than all that was measured.
  static SampleGrid Under(const std::vector<TimeNs>& t_ns);

  /// A grid from `first_ns` to `last_ns` on which several lists of samples stand, this one within.
  static SampleGrid Over(TimeNs first_ns, TimeNs last_ns, double period_s,
                         const std::vector<TimeNs>& t_ns);

  /// Its first places, with the samples that stand there.
  SampleGrid First(std::size_t places) const;

  /// Values of the samples at their places, straight in between.
  std::vector<double> Spread(const std::vector<double>& at_samples) const;
  /// The same as a series, valid where a sample is that may be used, 0 elsewhere.
  Series SpreadSeries(const std::vector<double>& at_samples, const std::vector<bool>& usable) const;
};

}  // namespace tera
