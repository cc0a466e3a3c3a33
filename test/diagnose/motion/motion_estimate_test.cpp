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
