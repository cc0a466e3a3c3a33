#include "diagnose/search/steady_gain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

/// Gains of `count` manoeuvres in which `possible` could be gained, `mean` of it is, with noise.
std::vector<ManoeuvreGain> Gains(std::size_t count, double possible, double mean, double scatter,
                                 std::uint64_t seed) {
  std::vector<ManoeuvreGain> gains;
  for (std::size_t m = 0; m < count; ++m) {
    gains.push_back({possible * (mean + scatter * Stream(seed, "gain").Gaussian(m)), possible});
  }
  return gains;
}

TEST(SteadyGain, HasTheProbabilityOfStudentsT) {
  // Shares 0.2, 0.4, 0.6 of a gain that is so large that noise is nothing: t = 0.4 / (0.2 / sqrt 3)
  // = 3.4641 with two degrees of freedom, whose upper tail is 0.5 (1 - t / sqrt(2 + t^2)).
  const std::vector<ManoeuvreGain> gains = {{0.2e9, 1e9}, {0.4e9, 1e9}, {0.6e9, 1e9}};
  EXPECT_NEAR(SteadyGainP(gains), 0.5 * (1 - 3.46410 / std::sqrt(2 + 12)), 1e-5);
}

TEST(SteadyGain, OfManyManoeuvresIsSurerThanOfOneThatIsAsLarge) {
  EXPECT_EQ(SteadyGainP({{5000, 5000}}), 1);
  EXPECT_EQ(SteadyGainP({{5000, 5000}, {5000, 5000}, {0.1, 0.1}}), 1);
  EXPECT_LT(SteadyGainP(Gains(8, 100, 1, 0.1, 1)), 1e-5);
  EXPECT_GT(SteadyGainP(Gains(8, 100, -1, 0.1, 1)), 0.999);
}

TEST(SteadyGain, OfErrorsThatLastAManoeuvreIsNotOfEachOfTheirSamples) {
  // Nothing is to be gained, but every manoeuvre errs by far more than noise, to either side: the
  // share of 4000 recordings that pass at 1 % is 1 % at most (binomial: 2.8 sigma above it 1.45 %).
  int passed = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    passed += SteadyGainP(Gains(6, 1e4, 0, 0.5, seed)) <= 0.01 ? 1 : 0;
  }
  EXPECT_LE(passed, 58);
  EXPECT_GE(passed, 22);
}

TEST(SteadyGain, OfManoeuvresThatDifferInSizeIsNoneTheSurer) {
  int passed = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    std::vector<ManoeuvreGain> gains = Gains(6, 1e4, 0, 0.5, seed);
    for (std::size_t m = 0; m < 3; ++m) gains[m].gain *= 0.02;
    passed += SteadyGainP(gains) <= 0.01 ? 1 : 0;
  }
  EXPECT_LE(passed, 58);
}

}  // namespace
}  // namespace tera
