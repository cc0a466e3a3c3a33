#pragma once

#include <array>

#include "diagnose/motion/motion_problem.h"

namespace tera {

/// An observation's residual (measured less predicted) about a motion and parameters.
///
/// Rows are its numbers; columns of `by_state` the numbers of the motion, then their first, then
/// their second derivatives.
struct LinearisedObservation {
  static constexpr int kMostParameters = 32;

  int rows = 0;
  Eigen::Matrix<double, 6, 1> residual, sigma;
  int noise = kNoParameter;  ///< the first noise channel; without one `sigma` holds
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_state;
  int parameters = 0;
  std::array<int, kMostParameters> parameter;
  Eigen::Matrix<double, 6, kMostParameters> by_parameter;
  SplineWeights weights;
};

/// The motion of one segment and the parameters as they are in it.
struct SegmentMotion {
  Eigen::MatrixXd coefficients;  ///< one row each, one column for each number
  /// Which numbers move, as far as it stands out of their noise: a row for each four coefficients,
  /// 1 where they do, else 0.
  Eigen::ArrayXXd moving;
  Eigen::VectorXd wandered;  ///< the parameters of the segment less those of all
  double shift_s = 0;        ///< the spline at t + shift_s is the motion at t
};

}  // namespace tera
