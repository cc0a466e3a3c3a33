#include "diagnose/search/block/locate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnose/search/toy_block.h"
#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

constexpr std::size_t kLocateSamples = 4500;
constexpr double kPeriod_s = 0.01;

/// A lever moves a joint, with a measurement error `error` of lever, angle and time, plus noise.
class Locating : public testing::Test {
 protected:
  using Error = std::function<double(double lever, double angle, double t_s)>;

  Location Of(const Error& error, const NoiseModel& noise_model = {.scale = 0.01, .dof = 8}) const {
    const std::vector<double> lever = ToyLever(kLocateSamples, 5);
    const Stream noise(5, "noise");
    Channel channel;
    channel.measured = MakeSeries(kPeriod_s, lever);
    Series residual = channel.measured, angle = residual, time = residual;
    double q_rad = 0;
    for (std::size_t k = 0; k < kLocateSamples; ++k) {
      const double t_s = kPeriod_s * static_cast<double>(k);
      q_rad += 0.5 * kPeriod_s * lever[k];
      angle.value[k] = q_rad;
      time.value[k] = t_s;
      residual.value[k] = error(lever[k], q_rad, t_s) + 0.01 * noise.Gaussian(k);
      channel.measured.value[k] += residual.value[k];
    }
    channel.variables = {{"lever", MakeSeries(kPeriod_s, lever)}, {"angle", angle}, {"time", time}};
    return Locate(channel, 0, residual, noise_model, {.at_rest = 0.01}, Stream(5, "shifts"));
  }
};

TEST_F(Locating, AnErrorThatDiesAwayIsAShareOfTheSimulatedValueByTime) {
  const Location location =
      Of([](double lever, double, double t_s) { return -0.5 * std::exp(-t_s / 8) * lever; });
  ASSERT_FALSE(location.regimes.empty());
  EXPECT_EQ(location.regimes[0].variable, "time");
  EXPECT_TRUE(location.regimes[0].is_share);
}

TEST_F(Locating, AGainThatDependsOnTheAngleIsAShareByTheAngle) {
  const Location location =
      Of([](double lever, double q_rad, double) { return 0.25 * std::sin(8 * q_rad) * lever; });
  ASSERT_FALSE(location.regimes.empty());
  EXPECT_EQ(location.regimes[0].variable, "angle");
  EXPECT_TRUE(location.regimes[0].is_share);
}

TEST_F(Locating, AnErrorAtSmallLeversDependsOnTheLeverItself) {
  const Location location =
      Of([](double lever, double, double) { return -std::clamp(lever, -0.15, 0.15); });
  ASSERT_FALSE(location.regimes.empty());
  EXPECT_EQ(location.regimes[0].variable, "lever");
  EXPECT_FALSE(location.regimes[0].is_share);
}

TEST_F(Locating, AnErrorThatStaysIsNotNoiseThatRemembers) {
  // A noise model fitted to the error itself, present from 10 s to 30 s.
  const Location location =
      Of([](double lever, double,
            double t_s) { return t_s > 10 && t_s < 30 ? std::copysign(0.1, lever) : 0.0; },
         {.ar = {0.99}, .scale = 0.03, .dof = 4});
  double inside = 0, outside = 0;
  for (const Segment& one : location.intervals) {
    for (std::size_t k = one.begin; k < one.end; ++k) {
      (k >= 1000 && k < 3000 ? inside : outside) += 1.0 / 2000;
    }
  }
  EXPECT_GT(inside, 0.9);
  EXPECT_LT(outside, 0.05);
}

TEST_F(Locating, NoiseDependsOnNothing) {
  EXPECT_TRUE(Of([](double, double, double) { return 0.0; }).intervals.empty());
  EXPECT_TRUE(Of([](double, double, double) { return 0.0; }).regimes.empty());
}

TEST_F(Locating, TheWorstIntervalIsTheLoudestInAllAndNotTheLongest) {
  const Location location = Of([](double, double, double t_s) {
    if (t_s > 10 && t_s < 13) return 0.5 * std::sin(5 * t_s);
    return t_s > 20 && t_s < 40 ? 0.05 * std::sin(5 * t_s) : 0.0;
  });
  ASSERT_GE(location.intervals.size(), 2u);
  const Segment& worst = location.intervals[location.worst];
  EXPECT_NEAR(kPeriod_s * static_cast<double>(worst.begin), 10, 0.5);
  EXPECT_NEAR(kPeriod_s * static_cast<double>(worst.end), 13, 0.5);
}

/// Share of the samples in intervals, under noise alone.
double FlaggedShare(const NoiseModel& noise, bool has_rest) {
  double flagged = 0;
  constexpr int kRuns = 12;
  for (int seed = 0; seed < kRuns; ++seed) {
    Channel channel;
    channel.measured = NoiseSeries(noise, kLocateSamples, Stream(seed, "noise alone"));
    NoiseLevel level{{}, 0.5 * std::sqrt(VarianceOf(noise))};  // differences miss slow noise
    if (has_rest) level.at_rest = std::sqrt(VarianceOf(noise));
    const Location location =
        Locate(channel, 0, channel.measured, noise, level, Stream(5, "shifts"));
    for (const Segment& one : location.intervals) {
      flagged += static_cast<double>(one.size()) / (kLocateSamples * kRuns);
    }
  }
  return flagged;
}

TEST(NoiseAlone, IsNoMismatchWhateverItsColour) {
  const std::vector<NoiseModel> colours = {
      {.scale = 0.01, .dof = 4},
      {.ar = {0.8}, .scale = 0.01, .dof = 5},
      {.ar = {-0.5}, .scale = 0.01, .dof = 8},
      {.ar = {-0.8, -0.6, -0.4, -0.2}, .scale = 0.01, .dof = 8}};
  for (const NoiseModel& noise : colours) {
    EXPECT_LT(FlaggedShare(noise, true), 0.02) << noise.ar.size();
    EXPECT_LT(FlaggedShare(noise, false), 0.02) << noise.ar.size();
  }
}

TEST(NoiseAlone, AnErrorIsFoundWhereThereIsNoNoise) {
  Channel channel;
  channel.measured = MakeSeries(kPeriod_s, std::vector<double>(kLocateSamples, 0.0));
  for (std::size_t k = 1000; k < 2000; ++k) channel.measured.value[k] = 0.1;
  const Location location = Locate(channel, 0, channel.measured, {.scale = 1e-9, .dof = 8},
                                   {.at_rest = 0.0}, Stream(5, "shifts"));
  EXPECT_FALSE(location.intervals.empty());
}

TEST_F(Locating, ALoudErrorOfNothingThatWasRecordedHasNoVariable) {
  int told = 0;
  for (int seed = 0; seed < 10; ++seed) {
    const Series slow = NoiseSeries({.ar = {0.98}, .scale = 0.02, .dof = 50}, kLocateSamples,
                                    Stream(seed, "unknown cause"));
    const auto error = [&](double, double, double t_s) {
      return slow.value[static_cast<std::size_t>(t_s / kPeriod_s + 0.5)];
    };
    told += Of(error).regimes.empty() ? 0 : 1;
  }
  EXPECT_LE(told, 3);
}

}  // namespace
}  // namespace tera
