#pragma once

#include <Eigen/Core>

namespace tera {

/// Measurements of an inertial unit after a first-order low pass. Columns are instants of the
/// segment's spline, `step_s` apart, from 0 s on.
///
/// Model   T y' = x - y, with x the unfiltered measurement. The solution is exact where x is linear
///         between instants and has been linear before the first one.
struct FilteredUnit {
  using Rows = Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< turn rates, then specific forces
  double step_s = 0;
  Rows value;     ///< y of the estimated motion
  Rows resting;   ///< y of the motion with insignificant rates set to zero (SegmentMotion::moving)
  Rows by_delay;  ///< derivative of `resting` by the delay, -y'
  Rows by_time_constant;  ///< derivative of `resting` by T

  /// `moved` and `rests` are the unfiltered measurements for `value` and for `resting`. T must be
  /// positive.
  FilteredUnit(double every_s, double time_constant_s, const Rows& moved, const Rows& rests);
  /// Mean over a time span by Simpson's rule. Outside the instants the nearest column counts.
  Eigen::Matrix<double, 6, 1> MeanOver(const Rows& rows, double from_s, double to_s) const;
};

}  // namespace tera
