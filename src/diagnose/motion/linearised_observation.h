#pragma once

#include <array>

#include "diagnose/motion/motion_problem.h"

namespace tera {

/// The residual (measured minus predicted) and derivatives of one observation.
///
/// Rows are the measured numbers. Columns of `by_state` are the coordinates of the motion, then
/// their first derivatives, then their second derivatives.
struct LinearisedObservation {
  static constexpr int kMostParameters = 32;

  int rows = 0;
  Eigen::Matrix<double, 6, 1> residual, sigma;
  int noise = kNoParameter;  ///< first noise channel; without one, `sigma` holds
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_state;
  int parameters = 0;
  std::array<int, kMostParameters> parameter;
  Eigen::Matrix<double, 6, kMostParameters> by_parameter;
  SplineWeights weights;
};

/// The motion of one segment and the deviation of its parameters.
struct SegmentMotion {
  Eigen::MatrixXd coefficients;  ///< row: coefficient; column: coordinate
  /// 1 where a coordinate moves significantly more than its noise, else 0. One row per four
  /// coefficients, one column per coordinate.
  Eigen::ArrayXXd moving;
  Eigen::VectorXd wandered;  ///< parameters of this segment minus the shared parameters
  double shift_s = 0;        ///< the motion at t is the spline at t + shift_s
};

}  // namespace tera
