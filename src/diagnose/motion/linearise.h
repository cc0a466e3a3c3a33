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

/// Fills `out`; false where the motion does not cover the time of the observation.
///
/// Model   an inertial unit: rates and forces of its true frame, averaged over the observation as
///         the splines are (UniformSpline::MeanOver), signs, scale, bias. A receiver: its antenna's
///         place. All are as late as their parameter says. Accelerations count in inertial units
///         with the gain of their number of the motion, which all units share.
///         Derivatives by parameters are those of a motion that rests where it does not exceed its
///         noise. Otherwise a motion that follows a sensor's noise would seem to excite its scale,
///         place and delay, and the noise would bias these (errors in variables).
/// Omits   products of motions that change within an observation; filters, which count as delays.
bool Linearise(const MotionProblem& problem, const UniformSpline& spline,
               const SegmentMotion& motion, const Eigen::VectorXd& parameters,
               const Observation& observation, LinearisedObservation* out);

}  // namespace tera
