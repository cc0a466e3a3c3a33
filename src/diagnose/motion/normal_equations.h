#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnose/motion/linearise.h"

namespace tera {

/// The quadratic 1/2 p' `information` p - `score`' p over the parameters p: the cost of a segment's
/// observations, minimised over its motion.
struct ParameterQuadratic {
  Eigen::MatrixXd information;
  Eigen::VectorXd score;

  double At(const Eigen::VectorXd& p) const { return p.dot(0.5 * (information * p) - score); }
};

/// Normal equations of one segment: spline coefficients of its motion, and the parameters.
///
/// Model   unknowns are ordered by time, so that the matrix is block-tridiagonal. A block is four
///         coefficients of all coordinates. Solved by blockwise Cholesky.
class NormalEquations {
 public:
  /// `coefficients` must be a multiple of four.
  explicit NormalEquations(int coefficients = 0, int numbers = 0, int parameters = 0);

  /// Adds the rows of an observation. Weights are inverse variances.
  void Add(const LinearisedObservation& rows, const Eigen::Matrix<double, 6, 1>& weight);
  /// Adds the cost weight / 2 (residual - sum_i pattern_i d_i)^2, with d_i the change of
  /// coefficient first + i of `number`.
  void AddPrior(int first, int number, const std::vector<double>& pattern, double residual,
                double weight);

  /// Eliminates the motion. Returns the quadratic over changes of the parameters from the point of
  /// linearisation. Rows cannot be added afterwards.
  ParameterQuadratic Reduce();
  /// The optimal change of the motion for a change of the parameters. Requires Reduce.
  Eigen::VectorXd MotionStep(const Eigen::VectorXd& change) const;
  /// The covariance of the coefficients in each block for fixed parameters. Requires Reduce.
  std::vector<Eigen::MatrixXd> Covariance() const;

 private:
  int block_, blocks_, numbers_, parameters_;
  std::vector<Eigen::MatrixXd> pair_;  ///< each block with the next one; empty after Reduce
  /// Lower Cholesky factor of each block, and the off-diagonal block below it.
  std::vector<Eigen::MatrixXd> factor_, below_;
  /// Coupling to the parameters, then the gradient; forward-eliminated by Reduce.
  Eigen::MatrixXd right_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd score_;
};

}  // namespace tera
