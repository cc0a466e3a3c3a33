#pragma once

#include <Eigen/Core>

namespace tera {

/// Weights of up to five consecutive coefficients, beginning with `first`. Rows are the value of
/// the spline and its first three derivatives.
struct SplineWeights {
  int first = 0;
  Eigen::Matrix<double, 4, 5> by_derivative = Eigen::Matrix<double, 4, 5>::Zero();
};

/// Uniform cubic B-splines on [0, end_s()]. Coefficient i is centred on (i - 1) `step_s`.
///
/// Source  de Boor 2001, "A practical guide to splines", ch. IX.
struct UniformSpline {
  double step_s = 0.1;
  int coefficients = 4;

  double end_s() const { return step_s * (coefficients - 3); }
  bool Covers(double from_s, double to_s) const { return from_s >= 0 && to_s <= end_s(); }
  /// Requires Covers(t_s, t_s).
  SplineWeights At(double t_s) const;
  /// Weights of the mean over a covered time span. Spans up to one step: exact for the derivatives,
  /// Simpson's rule for the value. Longer spans: the weights at the middle.
  SplineWeights MeanOver(double from_s, double to_s) const;
};

}  // namespace tera
