#include "diagnose/motion/motion_estimate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/in_parallel.h"
#include "diagnose/motion/bounded_quadratic.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

/// 1 sigma of third derivatives of base and joints
constexpr double kJerk_mps3 = 40, kJerk_radps3 = 60;
/// 1 sigma of the distance of each coefficient from its start.
constexpr double kPlace_m = 50, kLean_rad = 0.5, kYaw_rad = 5, kJoint = 2;
constexpr int kUnweightedIterations = 2;  ///< unweighted iterations of a first estimate
/// A coordinate moves where the power of its rate exceeds the error variance of the rate by this
/// factor.
constexpr double kStandsOut = 30;
/// Largest change of a parameter at convergence, over ParameterPrior::small.
constexpr double kSettled = 0.02;
/// Factors on the step of a delay: where its sign changes, and where it stays.
constexpr double kTurnsBack = 0.5, kGoesOn = 1.5;

struct LinearisedSegment {
  ParameterQuadratic quadratic;  ///< quadratic over changes of this segment's parameters
  NormalEquations equations;
  /// By noise channel, scaled to the noise without model error.
  std::vector<std::vector<double>> residuals;
};

/// Error variance of one row: inflated noise variance of the mean, plus squared model error.
double VarianceOf(const Observation& observation, int row, double sigma, double inflation = 1) {
  return inflation * sigma * sigma / observation.share + std::pow(observation.model_error[row], 2);
}

struct RowWeights {
  bool robust = true;

  Eigen::Matrix<double, 6, 1> Of(const LinearisedObservation& rows, const Observation& observation,
                                 const std::vector<NoiseChannel>& noise) const {
    Eigen::Matrix<double, 6, 1> weight = rows.sigma.cwiseProduct(rows.sigma).cwiseInverse();
    for (int i = 0; rows.noise >= 0 && i < rows.rows; ++i) {
      const NoiseChannel& channel = noise[static_cast<std::size_t>(rows.noise + i)];
      const double sigma = robust ? channel.sigma : channel.at_first;
      const double alone = VarianceOf(observation, i, sigma);
      weight[i] = robust ? ErrorWeight(rows.residual[i], std::sqrt(alone)) /
                               VarianceOf(observation, i, sigma, channel.inflation)
                         : 1 / alone;
    }
    return weight;
  }
};

void AddMotionPriors(const MotionSegment& segment, const Eigen::MatrixXd& now,
                     NormalEquations* equations) {
  const double h = segment.spline.step_s, cube = h * h * h;
  for (int number = 0; number < now.cols(); ++number) {
    const double jerk = number < 3 ? kJerk_mps3 : kJerk_radps3;
    const double away = number < 3              ? kPlace_m
                        : number == kYaw        ? kYaw_rad
                        : number < kBaseNumbers ? kLean_rad
                                                : kJoint;
    for (int i = 0; i < now.rows(); ++i) {
      equations->AddPrior(i, number, {1.0}, segment.start(i, number) - now(i, number),
                          1 / (away * away));
      if (i + 4 > now.rows()) continue;
      const double third =
          now(i + 3, number) - 3 * now(i + 2, number) + 3 * now(i + 1, number) - now(i, number);
      equations->AddPrior(i, number, {-1, 3, -3, 1}, -third, 1 / std::pow(jerk * cube, 2));
    }
  }
}

/// Removes a segment's information on the delay that all channels share. Such a delay is the same
/// as a late motion. A linearisation about a motion that follows noise would wrongly seem to
/// determine it.
///
/// Model   the result at p is `q` at p - u w'p. u is 1 for each delay, and w is the share of each
///         delay in the segment's information on delays.
ParameterQuadratic WithoutCommonDelay(const ParameterQuadratic& q, const std::vector<int>& delays) {
  const auto count = q.score.size();
  Eigen::VectorXd common = Eigen::VectorXd::Zero(count), share = common;
  for (const int i : delays) {
    common[i] = 1;
    share[i] = q.information(i, i);
  }
  const double all = share.sum();
  if (all <= 0) return q;
  const Eigen::MatrixXd apart =
      Eigen::MatrixXd::Identity(count, count) - common * (share / all).transpose();
  return {apart.transpose() * q.information * apart, apart.transpose() * q.score};
}

LinearisedSegment LineariseSegment(const MotionProblem& problem, std::size_t s,
                                   const MotionEstimate& at, const RowWeights& weights) {
  const MotionSegment& segment = problem.segments[s];
  const SegmentMotion& motion = at.motion[s];
  const Eigen::VectorXd parameters = at.parameters + motion.wandered;
  LinearisedSegment linear;
  NormalEquations& equations = linear.equations;
  equations = NormalEquations(segment.spline.coefficients, problem.numbers(), problem.parameters);
  AddMotionPriors(segment, motion.coefficients, &equations);
  linear.residuals.resize(problem.noise.size());
  const SegmentLinearisation linearisation(problem, segment.spline, motion, parameters);
  LinearisedObservation rows;
  for (const Observation& observation : segment.observations) {
    if (!linearisation.Of(observation, &rows)) continue;
    for (int i = 0; rows.noise >= 0 && i < rows.rows; ++i) {
      const auto c = static_cast<std::size_t>(rows.noise + i);
      const double sigma = at.noise[c].sigma;
      linear.residuals[c].push_back(rows.residual[i] * sigma /
                                    std::sqrt(VarianceOf(observation, i, sigma)));
    }
    equations.Add(rows, weights.Of(rows, observation, at.noise));
  }
  linear.quadratic = WithoutCommonDelay(equations.Reduce(), problem.delays);
  return linear;
}

/// SegmentMotion::moving, from the power of each rate over three blocks. It applies to all
/// derivatives of a coordinate together: a subset would not give a descent direction.
Eigen::ArrayXXd MovingOf(const UniformSpline& spline, const Eigen::MatrixXd& coefficients,
                         const std::vector<Eigen::MatrixXd>& covariance) {
  const auto blocks = static_cast<Eigen::Index>(covariance.size());
  const Eigen::Index numbers = coefficients.cols();
  const Eigen::RowVector4d weights = spline.At(0.5 * spline.step_s).by_derivative.row(1).head<4>();
  Eigen::ArrayXXd power(blocks, numbers), error(blocks, numbers);
  for (Eigen::Index b = 0; b < blocks; ++b) {
    for (Eigen::Index n = 0; n < numbers; ++n) {
      const auto four = Eigen::seqN(n, 4, numbers);
      const Eigen::Matrix4d own = covariance[static_cast<std::size_t>(b)](four, four);
      power(b, n) = std::pow(weights.dot(coefficients.block<4, 1>(4 * b, n)), 2);
      error(b, n) = weights * own * weights.transpose();
    }
  }
  Eigen::ArrayXXd moving(blocks, numbers);
  for (Eigen::Index b = 0; b < blocks; ++b) {
    const Eigen::Index first = std::max<Eigen::Index>(0, b - 1),
                       count = std::min(blocks, b + 2) - first;
    moving.row(b) = (power.middleRows(first, count).colwise().mean() > kStandsOut * error.row(b))
                        .cast<double>();
  }
  return moving;
}

/// Parameters whose values deviate from segment to segment.
class Wandering {
 public:
  explicit Wandering(const Eigen::VectorXd& sigma) {
    for (Eigen::Index i = 0; i < sigma.size(); ++i) {
      if (sigma[i] > 0) which_.push_back(i), precision_.push_back(1 / (sigma[i] * sigma[i]));
    }
  }
  /// The deviations that minimise a segment's quadratic where the shared parameters are `p`.
  Eigen::VectorXd Best(const ParameterQuadratic& q, const Eigen::VectorXd& p) const {
    const Eigen::VectorXd pull = q.score - q.information * p;
    Eigen::VectorXd wandered = Eigen::VectorXd::Zero(p.size());
    const Eigen::VectorXd own = pull(which_);
    const Eigen::VectorXd best = Stiffness(q).llt().solve(own);
    wandered(which_) = best;
    return wandered;
  }
  /// The quadratic over the shared parameters, with the segment's deviations eliminated.
  ParameterQuadratic IntegrateOut(const ParameterQuadratic& q) const {
    if (which_.empty()) return q;
    const auto stiffness = Stiffness(q).llt();
    const Eigen::MatrixXd across = q.information(which_, Eigen::all);
    ParameterQuadratic left;
    left.information = q.information - across.transpose() * stiffness.solve(across);
    const Eigen::VectorXd own = q.score(which_);
    left.score = q.score - across.transpose() * stiffness.solve(own);
    return left;
  }

 private:
  Eigen::MatrixXd Stiffness(const ParameterQuadratic& q) const {
    Eigen::MatrixXd stiffness = q.information(which_, which_);
    for (std::size_t i = 0; i < which_.size(); ++i) {
      stiffness(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += precision_[i];
    }
    return stiffness;
  }
  std::vector<Eigen::Index> which_;
  std::vector<double> precision_;
};

/// Converts quadratics over changes of a segment's parameters to quadratics over the parameters
/// themselves.
std::vector<ParameterQuadratic> Absolute(const std::vector<LinearisedSegment>& linear,
                                         const MotionEstimate& at) {
  std::vector<ParameterQuadratic> quadratics;
  for (std::size_t s = 0; s < linear.size(); ++s) {
    ParameterQuadratic q = linear[s].quadratic;
    q.score += q.information * (at.parameters + at.motion[s].wandered);
    quadratics.push_back(std::move(q));
  }
  return quadratics;
}

void GatherResiduals(const std::vector<LinearisedSegment>& linear, MotionEstimate* estimate) {
  estimate->residuals.assign(estimate->noise.size(), {});
  for (const LinearisedSegment& segment : linear) {
    for (std::size_t c = 0; c < segment.residuals.size(); ++c) {
      estimate->residuals[c].by_segment.push_back(segment.residuals[c]);
    }
  }
}

/// Halves the step of a delay each time its sign changes. Full steps oscillate, because derivatives
/// by delays use the motion with insignificant rates set to zero.
class DelaySteps {
 public:
  explicit DelaySteps(const std::vector<int>& delays)
      : delays_(delays), last_s_(delays.size(), 0), share_(delays.size(), 1) {}
  void Damp(Eigen::VectorXd* step) {
    for (std::size_t k = 0; k < delays_.size(); ++k) {
      double& own_s = (*step)[delays_[k]];
      share_[k] =
          own_s * last_s_[k] < 0 ? kTurnsBack * share_[k] : std::min(1.0, kGoesOn * share_[k]);
      last_s_[k] = own_s;
      own_s *= share_[k];
    }
  }

 private:
  const std::vector<int>& delays_;
  std::vector<double> last_s_, share_;
};

/// Median change of the delays.
double CommonChange_s(const std::vector<int>& delays, const Eigen::VectorXd& change) {
  std::vector<double> changes;
  for (const int i : delays) changes.push_back(change[i]);
  return changes.empty() ? 0 : Median(std::move(changes));
}

/// Moves to the minimum of the linearised problem. Returns the largest change of a parameter over
/// ParameterPrior::small.
double Move(const MotionProblem& problem, const std::vector<LinearisedSegment>& linear,
            const Wandering& wandering, const ParameterPrior& prior, bool gates,
            DelaySteps* damping, MotionEstimate* estimate) {
  const std::vector<ParameterQuadratic> own = Absolute(linear, *estimate);
  ParameterQuadratic sum = QuadraticOf(prior);
  estimate->quadratics.clear();
  for (const ParameterQuadratic& q : own) {
    estimate->quadratics.push_back(wandering.IntegrateOut(q));
    sum.information += estimate->quadratics.back().information;
    sum.score += estimate->quadratics.back().score;
  }
  const Eigen::VectorXd before = estimate->parameters;
  Eigen::VectorXd step =
      SmallestWithin(sum.information, sum.score, prior.lower, prior.upper) - before;
  damping->Damp(&step);
  const double shift_s = CommonChange_s(problem.delays, step);
  SetParameters(problem.delays, before + step, estimate);
  for (std::size_t s = 0; s < linear.size(); ++s) {
    SegmentMotion& motion = estimate->motion[s];
    const Eigen::VectorXd wandered = wandering.Best(own[s], estimate->parameters);
    Eigen::VectorXd change = estimate->parameters + wandered - before - motion.wandered;
    for (const int i : problem.delays) change[i] -= shift_s;
    const Eigen::VectorXd moved = linear[s].equations.MotionStep(change);
    const Eigen::Index numbers = motion.coefficients.cols();
    for (Eigen::Index i = 0; i < motion.coefficients.rows(); ++i) {
      motion.coefficients.row(i) += moved.segment(i * numbers, numbers).transpose();
    }
    motion.wandered = wandered;
    if (gates) {
      const auto covariance = linear[s].equations.Covariance();
      motion.moving = MovingOf(problem.segments[s].spline, motion.coefficients, covariance);
    }
  }
  return before.size() == 0
             ? 0
             : (estimate->parameters - before).cwiseQuotient(prior.small).cwiseAbs().maxCoeff();
}

}  // namespace

ParameterQuadratic QuadraticOf(const ParameterPrior& prior) {
  const Eigen::VectorXd precision = prior.sigma.cwiseProduct(prior.sigma).cwiseInverse();
  return {precision.asDiagonal(), precision.cwiseProduct(prior.documented)};
}

MotionEstimate StartingEstimate(const MotionProblem& problem, const ParameterPrior& prior) {
  MotionEstimate start;
  start.parameters = prior.documented;
  start.noise = problem.noise;
  for (const MotionSegment& segment : problem.segments) {
    start.motion.push_back(
        {segment.start, Eigen::ArrayXXd::Ones(segment.spline.coefficients / 4, problem.numbers()),
         Eigen::VectorXd::Zero(problem.parameters)});
  }
  return start;
}

void SetParameters(const std::vector<int>& delays, const Eigen::VectorXd& parameters,
                   MotionEstimate* estimate) {
  const double shift_s = CommonChange_s(delays, parameters - estimate->parameters);
  for (SegmentMotion& motion : estimate->motion) motion.shift_s += shift_s;
  estimate->parameters = parameters;
}

MotionEstimate EstimateMotion(const MotionProblem& problem, const ParameterPrior& prior,
                              MotionEstimate start, const EstimateOptions& options) {
  MotionEstimate estimate = std::move(start);
  const Wandering wandering(problem.wander);
  const int unweighted =
      options.estimates_noise && estimate.iterations == 0 ? kUnweightedIterations : 0;
  estimate.converged = false;
  DelaySteps damping(problem.delays);
  for (int i = 0; i <= options.most_iterations; ++i) {
    const auto linear =
        InParallel<LinearisedSegment>(problem.segments.size(), options.threads, [&](std::size_t s) {
          return LineariseSegment(problem, s, estimate, {i > unweighted || unweighted == 0});
        });
    GatherResiduals(linear, &estimate);
    if (options.estimates_noise && i >= unweighted) {
      EstimateNoise(estimate.residuals, &estimate.noise);
    }
    const double change = Move(problem, linear, wandering, prior,
                               i >= unweighted && options.estimates_noise, &damping, &estimate);
    ++estimate.iterations;
    estimate.converged = i > unweighted + 1 && change < kSettled;
    if (estimate.converged) break;
  }
  return estimate;
}

}  // namespace tera
