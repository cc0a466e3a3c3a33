#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnose/motion/motion_problem.h"
#include "diagnose/motion/normal_equations.h"
#include "diagnose/motion/residual_noise.h"

namespace tera {

/// Prior of the parameters: normal with mean `documented`, truncated to the bounds.
struct ParameterPrior {
  Eigen::VectorXd documented, sigma, lower, upper;  ///< bounds may be infinite
  Eigen::VectorXd small = sigma;  ///< scale for convergence: changes far below it do not matter
};

struct MotionEstimate {
  std::vector<SegmentMotion> motion;
  Eigen::VectorXd parameters;
  std::vector<NoiseChannel> noise;
  /// One quadratic per segment over the shared parameters. The segment's own deviations of its
  /// parameters are eliminated.
  std::vector<ParameterQuadratic> quadratics;
  std::vector<ChannelResiduals> residuals;  ///< one per noise channel
  int iterations = 0;
  bool converged = false;
};

struct EstimateOptions {
  int most_iterations = 7;
  bool estimates_noise = true;
  int threads = 1;
};

/// The starting estimate: documented parameters, and MotionSegment::start of each segment.
MotionEstimate StartingEstimate(const MotionProblem& problem, const ParameterPrior& prior);

/// Replaces the parameters. The median change of the delays shifts the motion in time, exactly.
/// Reason: a delay common to all channels is the same as a late motion, and a linear step of spline
/// coefficients cannot represent a time shift.
void SetParameters(const std::vector<int>& delays, const Eigen::VectorXd& parameters,
                   MotionEstimate* estimate);

/// Estimates motion and parameters together, beginning at `start`.
///
/// Model   Gauss-Newton. Rows carry Student-t weights, divided by the variance inflation of their
///         channel; the first two iterations of a first estimate are unweighted. Each segment's
///         motion (NormalEquations) and its own deviations of parameters are eliminated. The sum of
///         the remaining quadratics and the prior is minimised within the bounds. Only the prior
///         determines a delay common to all channels. A weak prior on the third derivatives of the
///         motion bridges lost rows. A weak prior on its coefficients holds unmeasured coordinates.
MotionEstimate EstimateMotion(const MotionProblem& problem, const ParameterPrior& prior,
                              MotionEstimate start, const EstimateOptions& options = {});

/// The prior as a quadratic, without the bounds.
ParameterQuadratic QuadraticOf(const ParameterPrior& prior);

}  // namespace tera
