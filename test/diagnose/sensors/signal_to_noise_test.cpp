#include "diagnose/sensors/signal_to_noise.h"

#include <gtest/gtest.h>

#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

/// Segments of ten seconds, with a reading every tenth of a second.
MotionProblem Segments(std::size_t count) {
  MotionProblem motion;
  motion.segments.resize(count);
  for (MotionSegment& segment : motion.segments) {
    for (int k = 0; k < 100; ++k) {
      segment.observations.push_back({.from_s = 0.1 * k, .to_s = 0.1 * (k + 1)});
    }
  }
  return motion;
}

/// A reading is a y + noise of 0.2, with y the second of two parameters: a^2 / 0.04 for each of
/// 100.
ParameterQuadratic Read(double a) {
  ParameterQuadratic q = {Eigen::MatrixXd::Zero(2, 2), Eigen::VectorXd::Zero(2)};
  q.information(1, 1) = 100 * a * a / 0.04;
  q.information(0, 0) = 1e6;
  return q;
}

ParameterTable Table() {
  ParameterTable table;
  table.parameters.resize(2);
  table.parameters[1].documented = 1;
  table.groups = {{{"first", &SensorMechanism("bias", EffectTarget::kImu)}, 0, 1},
                  {{"second", &SensorMechanism("scale", EffectTarget::kImu)}, 1, 1}};
  return table;
}

NamedGroup Found(double value) { return {1, {{value, 0.01, true}}, 0, 0, {}}; }

// 0.3 more than documented: a reading changes by 0.3 a, over noise of 0.2.
TEST(SignalToNoise, IsWhatAFindingChangesInTheThirdLoudestSegment) {
  EXPECT_NEAR(SignalToNoise(Segments(5), {Read(5), Read(2), Read(0), Read(4), Read(0)}, Table(),
                            Found(1.3)),
              0.3 * 2 / 0.2, 1e-9);
  EXPECT_NEAR(SignalToNoise(Segments(5), {Read(5), Read(0), Read(0), Read(4), Read(0)}, Table(),
                            Found(1.3)),
              0, 1e-9);
}

TEST(SignalToNoise, OfFewSegmentsIsThatOfTheQuietest) {
  EXPECT_NEAR(SignalToNoise(Segments(2), {Read(5), Read(2)}, Table(), Found(0.9)), 1, 1e-9);
  EXPECT_EQ(SignalToNoise(Segments(0), {}, Table(), Found(0.9)), 0);
}

// The first parameter changes readings by far more, and is within its tolerance.
TEST(SignalToNoise, OfANumberWithinToleranceIsNotThatOfTheFinding) {
  ParameterTable table = Table();
  table.groups = {{{"both", &SensorMechanism("scale", EffectTarget::kImu)}, 0, 2}};
  const NamedGroup found = {0, {{0.5, 0.01, false}, {1.3, 0.01, true}}, 0, 0, {}};
  EXPECT_NEAR(SignalToNoise(Segments(3), {Read(5), Read(2), Read(4)}, table, found), 3, 1e-9);
}

}  // namespace
}  // namespace tera
