#include "diagnose/motion/motion_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

// Two encoders of one joint, the second with an unknown zero. Its estimate is the mean of their
// differences, with the sum of both noise variances over the number of samples.

namespace tera {
namespace {

constexpr double kMotionEstimateInfinity = std::numeric_limits<double>::infinity();
constexpr double kSigma[] = {0.01, 0.02};
constexpr int kSamples = 500;  // of each encoder and segment, 5 s at 100 Hz
/// Residuals much smaller than the scale have the weight (5 + 1) / 5.
constexpr double kWeightOfSmall = 1.2;

double Angle(int segment, double t) { return 0.3 * segment + 0.5 * std::sin(1.3 * t); }

/// `scale` times the noise that the channels state; the second encoder reads `zero` more.
MotionProblem TwoEncoders(int segments, double scale, double zero) {
  MotionProblem problem;
  problem.joints = {"boom"};
  problem.axes.resize(2);
  problem.axes[0].noise = 0;
  problem.axes[1] = {.bias = 0, .noise = 1};
  problem.noise = {{"first", "rad", 1e-6, 0.1, kSigma[0], 1},
                   {"second", "rad", 1e-6, 0.1, kSigma[1], 1}};
  problem.parameters = 1;
  problem.wander = Eigen::VectorXd::Zero(1);
  const Stream draw(1, "encoders");
  for (int s = 0; s < segments; ++s) {
    MotionSegment segment;
    segment.spline = {.step_s = 0.1, .coefficients = 64};
    segment.start = Eigen::MatrixXd::Zero(64, problem.numbers());
    segment.start.col(kBaseNumbers).setConstant(Angle(s, 0));
    for (int k = 0; k < kSamples; ++k) {
      for (int i = 0; i < 2; ++i) {
        const double t = 0.5 + 0.01 * k;
        Observation seen = {.kind = ObservationKind::kAxis, .channel = i, .from_s = t, .to_s = t};
        seen.value[0] =
            Angle(s, t) + i * zero + scale * kSigma[i] * draw.Gaussian(k + 10000 * s, i);
        segment.observations.push_back(seen);
      }
    }
    problem.segments.push_back(segment);
  }
  return problem;
}

ParameterPrior Prior(double sigma, double lower = -kMotionEstimateInfinity,
                     double upper = kMotionEstimateInfinity) {
  const auto one = [](double value) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, value));
  };
  return {one(0), one(sigma), one(lower), one(upper)};
}

MotionEstimate Estimated(const MotionProblem& problem, const ParameterPrior& prior,
                         bool estimates_noise) {
  return EstimateMotion(problem, prior, StartingEstimate(problem, prior),
                        {.estimates_noise = estimates_noise});
}

const double kVariance = kSigma[0] * kSigma[0] + kSigma[1] * kSigma[1];

TEST(EstimateMotion, LeavesOfAZeroTheInformationOfTheMeanOfDifferences) {
  const MotionProblem problem = TwoEncoders(3, 0.01, 0.07);
  const MotionEstimate estimate = Estimated(problem, Prior(10), false);
  ASSERT_EQ(estimate.quadratics.size(), 3u);
  for (const ParameterQuadratic& quadratic : estimate.quadratics) {
    const double expected = kWeightOfSmall * kSamples / kVariance;
    EXPECT_NEAR(quadratic.information(0, 0), expected, 2e-3 * expected);
    EXPECT_NEAR(quadratic.score[0] / quadratic.information(0, 0), 0.07, 1e-4);
  }
  // A hundredth of the noise, from 1500 differences.
  EXPECT_NEAR(estimate.parameters[0], 0.07, 5 * 0.01 * std::sqrt(kVariance / 1500));
  EXPECT_TRUE(estimate.converged);
}

TEST(EstimateMotion, FindsZeroNoiseAndMotion) {
  const MotionEstimate estimate = Estimated(TwoEncoders(4, 1, 0.07), Prior(10), true);
  EXPECT_NEAR(estimate.parameters[0], 0.07, 5 * std::sqrt(kVariance / 2000));
  // The best scale of Student's t for normal errors is smaller than theirs, 0.87 of it for five
  // degrees of freedom.
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(estimate.noise[i].sigma / kSigma[i], 0.87, 0.07) << i;
  for (int s = 0; s < 4; ++s) {
    const UniformSpline spline = {.step_s = 0.1, .coefficients = 64};
    for (double t = 0.6; t < 5.4; t += 0.171) {
      const SplineWeights at = spline.At(t);
      const double found = at.by_derivative.row(0).head(4).dot(
          estimate.motion[s].coefficients.col(kBaseNumbers).segment(at.first, 4));
      // About twenty samples of both between knots, with 0.009 rad of noise.
      EXPECT_NEAR(found, Angle(s, t), 5 * 0.009 / std::sqrt(7)) << t;
    }
  }
}

TEST(EstimateMotion, StaysWithinBoundsAndGivesWayToItsPrior) {
  const MotionProblem problem = TwoEncoders(3, 0.1, 0.004);
  const MotionEstimate bounded = Estimated(problem, Prior(10, -0.001, 0.001), false);
  EXPECT_LE(bounded.parameters[0], 0.001);
  EXPECT_NEAR(bounded.parameters[0], 0.001, 1e-5);
  // Data of information I and a prior of 1 / sigma^2 = I contribute equally.
  const double information = 3 * kWeightOfSmall * kSamples / kVariance;
  const MotionEstimate held = Estimated(problem, Prior(1 / std::sqrt(information)), false);
  EXPECT_NEAR(held.parameters[0], 0.002, 5 * 0.5 * 0.1 * std::sqrt(kVariance / 1500));
}

// A parameter that walks by w between segments is known from one to 1 / I + w^2.
TEST(EstimateMotion, IntegratesOutWhatWandersFromSegmentToSegment) {
  MotionProblem problem = TwoEncoders(3, 0.01, 0.07);
  problem.wander[0] = 0.004;
  const MotionEstimate estimate = Estimated(problem, Prior(10), false);
  for (const ParameterQuadratic& quadratic : estimate.quadratics) {
    const double own = kWeightOfSmall * kSamples / kVariance;
    const double expected = 1 / (1 / own + 0.004 * 0.004);
    EXPECT_NEAR(quadratic.information(0, 0), expected, 5e-3 * expected);
  }
  EXPECT_NEAR(estimate.parameters[0], 0.07, 1e-3);
}

/// Two encoders whose stamps are late by these times, as parameters.
MotionProblem LateEncoders(double first_s, double second_s) {
  MotionProblem problem = TwoEncoders(3, 0, 0);
  const Stream draw(2, "late");
  for (std::size_t s = 0; s < 3; ++s) {
    std::uint64_t k = 0;
    for (Observation& seen : problem.segments[s].observations) {
      const double late_s = seen.channel == 0 ? first_s : second_s;
      seen.value[0] = Angle(static_cast<int>(s), seen.from_s - late_s) +
                      0.1 * kSigma[seen.channel] * draw.Gaussian(k++, static_cast<int>(s));
    }
  }
  problem.axes[0].late = 0;
  problem.axes[1] = {.late = 1, .noise = 1};
  problem.parameters = 2;
  problem.wander = Eigen::VectorXd::Zero(2);
  problem.delays = {0, 1};
  return problem;
}

ParameterPrior PriorOfDelays(double first_s, double second_s) {
  const Eigen::Vector2d far = Eigen::Vector2d::Constant(kMotionEstimateInfinity);
  return {Eigen::Vector2d(first_s, second_s), Eigen::Vector2d(1, 1), -far, far};
}

// Encoders alone do not reveal a delay of both. The prior divides their difference equally.
TEST(EstimateMotion, FindsByHowMuchOneIsLaterThanTheOther) {
  const MotionEstimate estimate = Estimated(LateEncoders(0.2, 0.3), PriorOfDelays(0, 0), false);
  // An angle of 0.5 sin 1.3 t has a rate of 0.46 rad/s in quadratic mean.
  const double sigma_s = 0.1 * std::sqrt(kVariance / 1500) / 0.46;
  EXPECT_NEAR(estimate.parameters[1] - estimate.parameters[0], 0.1, 5 * sigma_s);
  EXPECT_NEAR(estimate.parameters[1] + estimate.parameters[0], 0, 1e-3);
}

// If all channels are later by a time, the same motion is earlier by it.
TEST(EstimateMotion, WithAllDelaysLargerHasTheSameResiduals) {
  const MotionProblem problem = LateEncoders(0.2, 0.3);
  const MotionEstimate first = Estimated(problem, PriorOfDelays(0.2, 0.3), false);
  MotionEstimate later = first;
  SetParameters(problem.delays, first.parameters + Eigen::Vector2d(0.25, 0.25), &later);
  const EstimateOptions once{.most_iterations = 0, .estimates_noise = false};
  const MotionEstimate a = EstimateMotion(problem, PriorOfDelays(0.2, 0.3), first, once),
                       b = EstimateMotion(problem, PriorOfDelays(0.45, 0.55), later, once);
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t s = 0; s < 3; ++s) {
      const auto &x = a.residuals[c].by_segment[s], &y = b.residuals[c].by_segment[s];
      ASSERT_EQ(x.size(), y.size());
      for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], 1e-9);
    }
  }
  EXPECT_GT(a.residuals[0].by_segment[0].size(), 400u);
}

// A mean over half of the usual time has twice the variance, and so has a model error of one sigma.
TEST(EstimateMotion, WeighsByShareAndModelError) {
  const double whole =
      Estimated(TwoEncoders(1, 0.01, 0), Prior(10), false).quadratics[0].information(0, 0);
  MotionProblem half = TwoEncoders(1, 0.01, 0), blurred = half;
  for (Observation& seen : half.segments[0].observations) seen.share = 0.5;
  for (Observation& seen : blurred.segments[0].observations) {
    seen.model_error[0] = kSigma[seen.channel];
  }
  for (const MotionProblem& problem : {half, blurred}) {
    const MotionEstimate estimate = Estimated(problem, Prior(10), false);
    EXPECT_NEAR(estimate.quadratics[0].information(0, 0), whole / 2, 2e-3 * whole);
  }
}

TEST(EstimateMotion, IsTheSameWithOneThreadAndTwo) {
  const MotionProblem problem = TwoEncoders(3, 1, 0.07);
  const MotionEstimate start = StartingEstimate(problem, Prior(1));
  const MotionEstimate one = EstimateMotion(problem, Prior(1), start, {.threads = 1}),
                       two = EstimateMotion(problem, Prior(1), start, {.threads = 2});
  EXPECT_EQ(one.parameters, two.parameters);
  EXPECT_EQ(one.motion[1].coefficients, two.motion[1].coefficients);
}

TEST(EstimateMotion, OfNoParametersOrNoSegmentsDoesNotFail) {
  MotionProblem none = TwoEncoders(2, 1, 0);
  none.axes[1].bias = kNoParameter;
  none.parameters = 0;
  none.wander.resize(0);
  const ParameterPrior empty;
  const MotionEstimate without = Estimated(none, empty, true);
  EXPECT_TRUE(without.motion[0].coefficients.allFinite());
  const MotionEstimate nowhere = Estimated(TwoEncoders(0, 1, 0), Prior(1), true);
  EXPECT_EQ(nowhere.parameters[0], 0);
}

TEST(QuadraticOf, APriorIsLeastAtTheDocumentedValue) {
  ParameterPrior prior = Prior(0.5);
  prior.documented[0] = 3;
  const ParameterQuadratic quadratic = QuadraticOf(prior);
  EXPECT_DOUBLE_EQ(quadratic.information(0, 0), 4);
  EXPECT_DOUBLE_EQ(quadratic.score[0], 12);
}

}  // namespace
}  // namespace tera
