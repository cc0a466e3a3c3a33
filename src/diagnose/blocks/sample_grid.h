#pragma once

#include <cstddef>
#include <vector>

#include "core/time.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// Whether samples, two at least, come about evenly: not in bursts, and without a gap far longer
/// than all that was measured.
bool ComeEvenly(const std::vector<TimeNs>& t_ns);

/// A uniform grid of time under samples that come almost evenly.
///
/// Model   its period is the median step of the samples. A sample stands at the place nearest to
///         its time; of two at one place the first counts.
struct SampleGrid {
  double period_s = 0;
  std::size_t size = 0;
  std::vector<std::size_t> place;  ///< of each sample

  /// The grid under samples, two at least, whose times rise. Throws InputError where most of the
  /// grid would be empty: samples in bursts, or a gap far longer than all that was measured.
  static SampleGrid Under(const std::vector<TimeNs>& t_ns);

  /// A grid from `first_ns` to `last_ns` on which several lists of samples stand, this one within.
  static SampleGrid Over(TimeNs first_ns, TimeNs last_ns, double period_s,
                         const std::vector<TimeNs>& t_ns);

  /// The first places of the grid, with the samples that stand there.
  SampleGrid First(std::size_t places) const;

  /// Values of the samples at their places, interpolated linearly in between.
  std::vector<double> Spread(const std::vector<double>& at_samples) const;
  /// Values of the samples as a series: valid at places of usable samples, 0 elsewhere.
  Series SpreadSeries(const std::vector<double>& at_samples, const std::vector<bool>& usable) const;
};

}  // namespace tera
