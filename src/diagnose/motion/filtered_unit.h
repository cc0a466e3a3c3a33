#pragma once

#include <Eigen/Core>

namespace tera {

/// The measurements of an inertial unit behind a low pass of first order, over the time of a
/// segment's spline; a column for each instant, `step_s` apart from 0 on.
///
/// Model   T y' = x - y. Exact for a measurement x without the filter that is linear between
///         instants, and has been as it begins.
struct FilteredUnit {
  using Rows = Eigen::Matrix<double, 6, Eigen::Dynamic>;  ///< rates, then forces
  double step_s = 0;
  Rows value;             ///< y of the motion
  Rows resting;           ///< y of a motion that rests where it is noise
  Rows by_delay;          ///< derivative of `resting` by a delay, -y'
  Rows by_time_constant;  ///< derivative of `resting` by T

  /// Filters measurements of the motion and of the motion that rests. T is positive.
  FilteredUnit(double every_s, double time_constant_s, const Rows& moved, const Rows& rests);
  /// Mean over a time by Simpson's rule; beyond the instants the nearest counts.
  Eigen::Matrix<double, 6, 1> MeanOver(const Rows& rows, double from_s, double to_s) const;
};

}  // namespace tera
