#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnose/motion/motion_problem.h"
#include "diagnose/motion/normal_equations.h"
#include "diagnose/motion/residual_noise.h"

namespace tera {

/// Prior of the parameters: normal about `documented`, within bounds.
struct ParameterPrior {
  Eigen::VectorXd documented, sigma, lower, upper;  ///< bounds may be infinite
  Eigen::VectorXd small = sigma;                    ///< changes far below are none
};

struct MotionEstimate {
  std::vector<SegmentMotion> motion;
  Eigen::VectorXd parameters;
  std::vector<NoiseChannel> noise;
  /// One quadratic for each segment, over the parameters of all, with its own wandering integrated
  /// out.
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

/// Gives an estimate other parameters. A change common to all delays shifts its motion in time,
/// exactly. A late motion is indistinguishable from channels that are all late, and no linear step
/// of splines follows such a shift.
void SetParameters(const std::vector<int>& delays, const Eigen::VectorXd& parameters,
                   MotionEstimate* estimate);

/// Motion and parameters together, from `start` on.
///
/// Model   Gauss-Newton; rows are weighted as Student's t has it, from the third iteration of a
///         first estimate on, and by their channel's inflation. Each segment's motion is eliminated
///         (NormalEquations), and its own wandering of the parameters integrated out. The sum of
///         the remaining quadratics and the prior is minimised within the bounds. The prior alone
///         determines a delay common to all channels. A weak prior on the third derivatives of the
///         motion carries it over lost rows. Another on its place holds unmeasured numbers.
MotionEstimate EstimateMotion(const MotionProblem& problem, const ParameterPrior& prior,
                              MotionEstimate start, const EstimateOptions& options = {});

/// The parameters' quadratic of a prior.
ParameterQuadratic QuadraticOf(const ParameterPrior& prior);

}  // namespace tera
