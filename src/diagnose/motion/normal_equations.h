#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnose/motion/linearise.h"

namespace tera {

/// A quadratic over the parameters, 1/2 p' `information` p - `score`' p. It is the cost of a
/// segment's observations where its motion follows the parameters as well as it can.
struct ParameterQuadratic {
  Eigen::MatrixXd information;
  Eigen::VectorXd score;

  double At(const Eigen::VectorXd& p) const { return p.dot(0.5 * (information * p) - score); }
};

/// Normal equations of the coefficients of one segment's motion and the parameters.
///
/// Model   unknowns are ordered by time, so that they form a block-tridiagonal matrix, four
///         coefficients of all numbers a block; it is solved by blockwise Cholesky.
class NormalEquations {
 public:
  /// As many coefficients as a multiple of four.
  explicit NormalEquations(int coefficients = 0, int numbers = 0, int parameters = 0);

  /// Adds rows with weights (inverse variances), one for each of the observation's.
  void Add(const LinearisedObservation& rows, const Eigen::Matrix<double, 6, 1>& weight);
  /// Adds (sum_i pattern_i c_(first + i), number - target)^2 weight / 2.
  void AddPrior(int first, int number, const std::vector<double>& pattern, double residual,
                double weight);

  /// Eliminates the motion and returns the quadratic over the parameters, as changes from the point
  /// of linearisation. No rows can be added afterwards.
  ParameterQuadratic Reduce();
  /// The motion's best changes where the parameters change by so much; Reduce comes before.
  Eigen::VectorXd MotionStep(const Eigen::VectorXd& change) const;
  /// The covariance of the coefficients of each block, without that of the parameters; Reduce comes
  /// before.
  std::vector<Eigen::MatrixXd> Covariance() const;

 private:
  int block_, blocks_, numbers_, parameters_;
  std::vector<Eigen::MatrixXd> pair_;  ///< of a block and the next one, until they are factors
  /// The lower Cholesky factor of each block, and its rows below the block.
  std::vector<Eigen::MatrixXd> factor_, below_;
  Eigen::MatrixXd right_;  ///< coupling to the parameters, then the gradient; eliminated forwards
  Eigen::MatrixXd information_;
  Eigen::VectorXd score_;
};

}  // namespace tera
