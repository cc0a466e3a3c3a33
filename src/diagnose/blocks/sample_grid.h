#pragma once

#include <cstddef>
#include <vector>

#include "core/time.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// True if the samples are nearly even: no bursts, and no gap much longer than the rest of the
/// recording. Needs at least two samples.
bool ComeEvenly(const std::vector<TimeNs>& t_ns);

/// A series without gaps.
Series WholeSeries(double period_s, std::vector<double> values);

/// Uniform time grid for nearly even samples.
///
/// Model   The period is the median step of the samples. Each sample is assigned to the nearest
///         grid point. If two samples have the same grid point, the first counts.
struct SampleGrid {
  double period_s = 0;
  std::size_t size = 0;
  std::vector<std::size_t> place;  ///< grid point of each sample

  /// Grid of at least two samples with ascending times. Throws InputError if bursts or a long gap
  /// would leave most of the grid empty.
  static SampleGrid Under(const std::vector<TimeNs>& t_ns);

  /// Grid from `first_ns` to `last_ns`, which several lists of samples share. `t_ns` is one of
  /// them.
  static SampleGrid Over(TimeNs first_ns, TimeNs last_ns, double period_s,
                         const std::vector<TimeNs>& t_ns);

  /// The first `places` points of the grid, with their samples.
  SampleGrid First(std::size_t places) const;

  /// Values at all grid points, linearly interpolated between the samples.
  std::vector<double> Spread(const std::vector<double>& at_samples) const;
  /// Values as a series: valid at grid points of usable samples, 0 and invalid elsewhere.
  Series SpreadSeries(const std::vector<double>& at_samples, const std::vector<bool>& usable) const;
};

}  // namespace tera
