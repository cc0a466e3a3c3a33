#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnose/motion/motion_problem.h"
#include "diagnose/motion/normal_equations.h"
#include "diagnose/motion/residual_noise.h"

namespace tera {

/// What is known about parameters beforehand: normal about `documented`, within bounds.
struct ParameterPrior {
  Eigen::VectorXd documented, sigma, lower, upper;  ///< bounds may be infinite
  Eigen::VectorXd small = sigma;                    ///< changes far below are none
};

struct MotionEstimate {
  std::vector<SegmentMotion> motion;
  Eigen::VectorXd parameters;
  std::vector<NoiseChannel> noise;
  /// Of each segment over the parameters of all, its own wandering integrated out.
  std::vector<ParameterQuadratic> quadratics;
  std::vector<ChannelResiduals> residuals;  ///< one for each noise channel
  int iterations = 0;
  bool converged = false;
};

struct EstimateOptions {
  int most_iterations = 7;
  bool estimates_noise = true;
  int threads = 1;
};

/// The estimate with which a problem begins.
MotionEstimate StartingEstimate(const MotionProblem& problem, const ParameterPrior& prior);

/// Gives an estimate other parameters. By what all delays change alike its motion is shifted in
/// time, exactly: nothing else tells a motion that is late from channels that all are, and no
/// linear step of splines follows it.
void SetParameters(const std::vector<int>& delays, const Eigen::VectorXd& parameters,
                   MotionEstimate* estimate);

/// Motion and parameters together, from `start` on.
///
/// Model   Gauss-Newton; rows are weighted as Student's t has it, from the third iteration of a
///         first estimate on, and by their channel's inflation. Each segment's motion is eliminated
///         (NormalEquations), its own wandering of the parameters integrated out, and the sum of
///         what is left with the prior is least within the bounds. That all channels are late
///         alike, nothing tells but the prior. A weak prior on the third derivatives of the motion
///         carries it over lost rows, another on its place holds what nothing measures.
MotionEstimate EstimateMotion(const MotionProblem& problem, const ParameterPrior& prior,
                              MotionEstimate start, const EstimateOptions& options = {});

/// The parameters' quadratic of a prior.
ParameterQuadratic QuadraticOf(const ParameterPrior& prior);

}  // namespace tera
