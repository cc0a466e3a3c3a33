#include "diagnose/motion/starting_delays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

// A unit on a base that turns about the vertical, yaw = swing sin(5 t) / 5, with a known delay of
// its stamps.

namespace tera {
namespace {

constexpr double kRate = 5;  // amplitude of the alternating turn in rad/s, with a period of 1.26 s
constexpr double kWindow_s = 0.1;

MotionProblem Turning(double swing_radps, double late_s, double noise_radps) {
  MotionProblem problem;
  UnitChannel unit;
  unit.late = 0;
  unit.noise = 0;
  problem.imus = {unit};
  problem.noise.resize(6);
  problem.parameters = 1;
  problem.wander = Eigen::VectorXd::Zero(1);
  const Stream draw(1, "turning");
  for (int s = 0; s < 4; ++s) {
    MotionSegment segment;
    segment.spline = {.step_s = 0.05, .coefficients = 132};
    segment.start = Eigen::MatrixXd::Zero(132, kBaseNumbers);
    const double begins_s = 1.7 * s;
    for (int i = 0; i < 132; ++i) {
      segment.start(i, kYaw) = swing_radps / kRate * std::sin(kRate * (begins_s + 0.05 * (i - 1)));
    }
    for (int k = 0; k < 50; ++k) {
      const double from_s = 0.6 + kWindow_s * k, at_s = from_s + kWindow_s / 2;
      Observation seen = {
          .kind = ObservationKind::kImu, .from_s = from_s, .to_s = from_s + kWindow_s};
      seen.value << 0, 0, swing_radps * std::cos(kRate * (begins_s + at_s - late_s)), 0, 0, 9.81;
      for (int i = 0; i < 3; ++i) {
        seen.value[i] += noise_radps * draw.Gaussian(static_cast<std::uint64_t>(100 * s + k), i);
      }
      segment.observations.push_back(seen);
    }
    problem.segments.push_back(segment);
  }
  return problem;
}

double StartingDelay(const MotionProblem& problem, double documented_s) {
  MotionEstimate start;
  start.parameters = Eigen::VectorXd::Constant(1, documented_s);
  for (const MotionSegment& segment : problem.segments) {
    start.motion.push_back(
        {segment.start, Eigen::ArrayXXd::Ones(33, kBaseNumbers), Eigen::VectorXd::Zero(1)});
  }
  SetStartingDelays(problem, &start);
  return start.parameters[0];
}

TEST(StartingDelays, AreThatOfStampsFarFromTheDocumentedOnes) {
  for (const double late_s : {-0.4, -0.2, 0.25, 0.45}) {
    EXPECT_NEAR(StartingDelay(Turning(0.3, late_s, 0.05), 0), late_s, 0.026) << late_s;
  }
}

TEST(StartingDelays, AreLookedForAboutTheDocumentedOne) {
  EXPECT_NEAR(StartingDelay(Turning(0.3, 1.1, 0.05), 0.8), 1.1, 0.026);
}

// A machine at rest turns no unit: the best match of noise is no delay.
TEST(StartingDelays, StayAsDocumentedWhereNothingTurns) {
  EXPECT_EQ(StartingDelay(Turning(0, 0.3, 0.05), 0.02), 0.02);
}

TEST(StartingDelays, StayAsDocumentedWhereTheyAreRight) {
  EXPECT_EQ(StartingDelay(Turning(0.3, 0, 0.05), 0), 0);
}

}  // namespace
}  // namespace tera
