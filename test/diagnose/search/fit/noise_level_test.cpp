#include "diagnose/search/fit/noise_level.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/search/toy_block.h"
#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

constexpr std::size_t kSize = 20000;

/// A lever that is out for 2 s and rests for 4 s.
std::vector<double> NowAndThen() {
  std::vector<double> lever(kSize);
  for (std::size_t k = 0; k < kSize; ++k) lever[k] = k % 600 < 200 ? 0.5 : 0.0;
  return lever;
}

TEST(NoiseLevel, OfWhiteNoiseIsItsDeviationThoughASlowErrorIsTenTimesAsLarge) {
  std::vector<double> residual(kSize);
  for (std::size_t k = 0; k < kSize; ++k) {
    residual[k] = 0.03 * Stream(1, "noise").Gaussian(k) + 0.3 * std::sin(0.02 * k);
  }
  const Series series = MakeSeries(0.01, residual);
  const ReplayBlock block = ToyBlock(std::vector<double>(kSize, 0.5), series, {});
  const NoiseLevel level = NoiseLevelOf(block, 0, series, Mask(kSize, 1));
  EXPECT_FALSE(level.at_rest.has_value());
  EXPECT_NEAR(level.rms(), 0.03, 0.001);
}

TEST(NoiseLevel, OfStubbornNoiseShowsAtRestAndNotInDifferences) {
  // AR(1) with coefficient 0.95: third differences show little of it.
  NoiseModel stubborn = StubbornNoise();
  stubborn.dof = 200;
  stubborn.scale = 0.1 * std::sqrt(1 - 0.95 * 0.95);
  std::vector<double> residual = SimulateNoise(stubborn, kSize, Stream(2, "noise"));
  const std::vector<double> lever = NowAndThen();
  for (std::size_t k = 0; k < kSize; ++k) residual[k] += 2 * lever[k];  // and an error that moves
  const Series series = MakeSeries(0.01, residual);
  const ReplayBlock block = ToyBlock(lever, series, {});
  const NoiseLevel level = NoiseLevelOf(block, 0, series, Mask(kSize, 1));
  ASSERT_TRUE(level.at_rest.has_value());
  EXPECT_NEAR(*level.at_rest, 0.1, 0.01);
  EXPECT_LT(level.differences, 0.05);
}

// A channel known to rest has less noise there than its measurement elsewhere.
TEST(NoiseLevel, IsNotThatOfRestWhereRestWasKnown) {
  const std::vector<double> lever = NowAndThen();
  std::vector<double> residual(kSize, 1e-6);
  const Stream noise(3, "noise");
  for (std::size_t k = 0; k < kSize; ++k) {
    if (lever[k] != 0) residual[k] = 0.1 * noise.Gaussian(k);
  }
  const Series series = MakeSeries(0.01, residual);
  ReplayBlock block = ToyBlock(lever, series, {});
  ASSERT_TRUE(NoiseLevelOf(block, 0, series, Mask(kSize, 1)).at_rest.has_value());
  block.rest_shows_noise = false;
  EXPECT_FALSE(NoiseLevelOf(block, 0, series, Mask(kSize, 1)).at_rest.has_value());
}

}  // namespace
}  // namespace tera
