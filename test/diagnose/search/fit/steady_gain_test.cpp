#include "diagnose/search/fit/steady_gain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

/// Gains of `count` manoeuvres with a possible gain of `possible` and a mean gain of `mean`, with
/// noise.
std::vector<ManoeuvreGain> Gains(std::size_t count, double possible, double mean, double scatter,
                                 std::uint64_t seed) {
  std::vector<ManoeuvreGain> gains;
  for (std::size_t m = 0; m < count; ++m) {
    gains.push_back({possible * (mean + scatter * Stream(seed, "gain").Gaussian(m)), possible});
  }
  return gains;
}

TEST(SteadyGain, HasTheProbabilityOfStudentsT) {
  // Shares 0.2, 0.4, 0.6 of a gain so large that noise is negligible. t = 0.4 / (0.2 / sqrt 3) =
  // 3.4641 with two degrees of freedom, whose upper tail is 0.5 (1 - t / sqrt(2 + t^2)).
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
  // No gain is possible, but every manoeuvre errs by far more than noise, in either direction. At
  // most 1 % of 4000 recordings pass at 1 % (binomial: 2.8 sigma above it, 1.45 %).
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

/// Gains in five pieces of thirty, and no possible gain in the others.
std::vector<ManoeuvreGain> InFewOf(double gain, double possible) {
  std::vector<ManoeuvreGain> gains(30, {-0.2, 2.5});
  for (std::size_t k = 0; k < gains.size(); k += 6) gains[k] = {gain, possible};
  gains[0] = {8 * gain, 8 * possible};  // a single large one
  return gains;
}

TEST(Gain, IsWorthABetWhereFewManoeuvresTellClearly) {
  EXPECT_GT(SteadyGainP(InFewOf(60, 90)), 1e-3);
  // Five gains that count 2.25 each, minus 25 of 0.2: two for two tests, exp(-(11.25 - 5)).
  EXPECT_NEAR(GainP(InFewOf(60, 90)), 2 * std::exp(-6.25), 1e-12);
}

TEST(Gain, OfOneManoeuvreIsWorthNoMoreThanTen) {
  EXPECT_NEAR(GainP({{5000, 5000}}), 2 * std::exp(-2.25), 1e-12);
  EXPECT_EQ(GainP({{-5000, 5000}, {3, 10}}), 1);
  EXPECT_EQ(GainP({{1.5, 1.9}, {1.5, 1.9}, {1.5, 1.9}, {1.5, 1.9}}), 1);  // no information
}

TEST(Gain, IsTheSteadyOneWhereThatIsSurer) {
  const std::vector<ManoeuvreGain> steady = Gains(8, 4, 0.2, 0.02, 1);
  EXPECT_EQ(GainP(steady), SteadyGainP(steady));
  EXPECT_EQ(GainP({{-5000, 5000}, {-5000, 5000}, {-4000, 5000}}),
            SteadyGainP({{-5000, 5000}, {-5000, 5000}, {-4000, 5000}}));
}

TEST(Gain, ByChanceIsABetThatIsExpectedToPayNothing) {
  // The first prediction is true and noise normal: the gain in log-likelihood is normal, with mean
  // -possible and twice that as variance. Two pieces: p = 2 / w, so that the mean of 2 / p is at
  // most 1, and exactly 1 without the cap.
  for (const double possible : {2.0, 4.0}) {
    double sum = 0, square = 0;
    constexpr int kDraws = 20000;
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<ManoeuvreGain> gains;
      for (std::size_t m = 0; m < 2; ++m) {
        const double noise = Stream(static_cast<std::uint64_t>(draw), "gain").Gaussian(m);
        gains.push_back({-possible + std::sqrt(2 * possible) * noise, possible});
      }
      const double p = GainP(gains);
      const double worth = p < 1 ? 2 / p : 0;
      sum += worth, square += worth * worth;
    }
    const double mean = sum / kDraws, error = std::sqrt(square) / kDraws;
    EXPECT_LT(mean, 1 + 5 * error) << possible;
    EXPECT_GT(mean, 0.1) << possible;
  }
}

TEST(Gain, IsConfirmedBySteadyOnesOrByThreeThatAreClear) {
  const std::vector<ManoeuvreGain> clear(3, {50, 60});
  EXPECT_TRUE(AreConfirming({clear[0], clear[1], clear[2], {-0.5, 3}, {-0.6, 3}}, 0));
  EXPECT_FALSE(AreConfirming({clear[0], clear[1], {-0.5, 3}, {-0.6, 3}}, 0));
  EXPECT_TRUE(AreConfirming(Gains(8, 4, 0.2, 0.02, 1), 0.05));
}

/// Gains of `pieces` pieces by noise and an effect `there` times as large as predicted. Residuals
/// times the difference over the variance are normal, with twice the possible gain as variance. The
/// gain is that minus the possible one.
std::vector<ManoeuvreGain> OfEffect(std::uint64_t seed, int pieces, double possible, double there) {
  std::vector<ManoeuvreGain> gains;
  for (int m = 0; m < pieces; ++m) {
    const double noise = Stream(seed, "effect").Gaussian(static_cast<std::uint64_t>(m));
    const double product = 2 * possible * there + std::sqrt(2 * possible) * noise;
    gains.push_back({product - possible, possible});
  }
  return gains;
}

TEST(SteadyEffect, ByChanceIsFoundAsOftenAsItSays) {
  constexpr int kDraws = 4000;
  int below = 0;
  for (int draw = 0; draw < kDraws; ++draw) below += SteadyEffectP(OfEffect(draw, 9, 6, 0)) < 0.05;
  EXPECT_NEAR(below, 0.05 * kDraws, 4 * std::sqrt(0.05 * 0.95 * kDraws));
}

TEST(SteadyEffect, IsSeenWhereAGainIsStillDrownedInNoise) {
  int effect = 0, gain = 0;
  for (int draw = 0; draw < 200; ++draw) {
    effect += SteadyEffectP(OfEffect(draw, 9, 4, 1)) < 1e-3;
    gain += SteadyGainP(OfEffect(draw, 9, 4, 1)) < 1e-3;
  }
  // Student's t of nine pieces with a mean of 2.8 and of 1.4 standard deviations.
  EXPECT_GE(effect, 190);
  EXPECT_LE(gain, 120);
}

}  // namespace
}  // namespace tera
