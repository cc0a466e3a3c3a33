#pragma once

#include <cstddef>
#include <vector>

#include "core/time.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// Whether samples, at least two, are nearly even: no bursts, and no gap far longer than the whole
/// measured time.
bool ComeEvenly(const std::vector<TimeNs>& t_ns);

/// A series without gaps.
Series WholeSeries(double period_s, std::vector<double> values);

/// Uniform time grid for nearly even samples.
///
/// Model   the period is the median step of the samples. A sample is at the nearest grid point; of
///         two at one point, the first counts.
struct SampleGrid {
  double period_s = 0;
  std::size_t size = 0;
  std::vector<std::size_t> place;  ///< grid point of each sample

  /// The grid of samples, at least two, with ascending times. Throws InputError if most of the grid
  /// would be empty, because of bursts or a gap far longer than the whole measured time.
  static SampleGrid Under(const std::vector<TimeNs>& t_ns);

  /// A grid from `first_ns` to `last_ns` that several lists of samples share, this one included.
  static SampleGrid Over(TimeNs first_ns, TimeNs last_ns, double period_s,
                         const std::vector<TimeNs>& t_ns);

  /// The first points of the grid, with their samples.
  SampleGrid First(std::size_t places) const;

  /// The samples' values at their grid points, linearly interpolated in between.
  std::vector<double> Spread(const std::vector<double>& at_samples) const;
  /// The samples' values as a series: valid at points of usable samples, 0 elsewhere.
  Series SpreadSeries(const std::vector<double>& at_samples, const std::vector<bool>& usable) const;
};

}  // namespace tera
