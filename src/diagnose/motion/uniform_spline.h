#pragma once

#include <Eigen/Core>

namespace tera {

/// Up to five coefficients that follow each other, from `first` on, and their weights in the value
/// of a spline and its first three derivatives, one a row.
struct SplineWeights {
  int first = 0;
  Eigen::Matrix<double, 4, 5> by_derivative = Eigen::Matrix<double, 4, 5>::Zero();
};

/// Uniform cubic B-splines over the seconds from 0 on: coefficient i is centred on
/// (i - 1) `step_s`.
///
/// Source  de Boor 2001, "A practical guide to splines", ch. IX.
struct UniformSpline {
  double step_s = 0.1;
  int coefficients = 4;

  double end_s() const { return step_s * (coefficients - 3); }
  bool Covers(double from_s, double to_s) const { return from_s >= 0 && to_s <= end_s(); }
  /// At a time that it covers.
  SplineWeights At(double t_s) const;
  /// Weights of the means over a time that it covers, no longer than a step. They are exact for the
  /// derivatives, by Simpson's rule for the value. For longer times they are those of the middle.
  SplineWeights MeanOver(double from_s, double to_s) const;
};

}  // namespace tera
