#include "diagnose/sensors/path_lag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "core/random.h"

namespace tera {
namespace {

constexpr double kNear_s = 0.5;
constexpr double kAlpha = 0.01;

using Speed = std::function<double(double t_s)>;

/// A drive of `length_s`, and its fixes in a rotated frame.
struct Driven {
  double length_s = 75;
  Speed speed_mps, turning_radps;
  double late_s = 0, noise_m = 0.01, share = 1;
  double heading_rad = 0.7;
  std::uint64_t seed = 1;
  double gap_from_s = 0, gap_to_s = 0;  ///< without fixes

  PlanarPath Path() const {
    PlanarPath path{0, 0.05, {}};
    double yaw = 0;
    std::complex<double> at_m = 0;
    for (int k = 0; k <= length_s / path.step_s; ++k) {
      path.at_m.push_back(at_m);
      at_m += path.step_s * speed_mps(k * path.step_s) * std::polar(1.0, yaw);
      yaw += path.step_s * turning_radps(k * path.step_s);
    }
    return path;
  }
  std::vector<PlanarFix> Fixes() const {
    const Stream draw(seed, "fixes");
    const PlanarPath path = Path();
    std::vector<PlanarFix> fixes;
    for (int k = 0; k < length_s / 0.1; ++k) {
      const double t_s = 0.1 * k;
      if (t_s >= gap_from_s && t_s < gap_to_s) continue;
      const std::complex<double> noise(draw.Gaussian(k, 0), draw.Gaussian(k, 1));
      fixes.push_back(
          {t_s + late_s, share * std::polar(1.0, heading_rad) * path.At(t_s) + noise_m * noise});
    }
    return fixes;
  }
};

/// Starts, stops and turns drawn anew every few seconds.
Driven Restless(std::uint64_t seed) {
  const Stream draw(seed, "levers");
  const auto level = [draw](double t_s, int which) {
    const auto piece = static_cast<std::uint64_t>(t_s / 3.1);
    const double at = draw.Uniform(piece, static_cast<std::uint32_t>(which));
    return at < 0.4 ? 0.0 : 2 * at - 1;
  };
  Driven driven;
  driven.seed = seed;
  driven.speed_mps = [level](double t_s) { return level(t_s, 0); };
  driven.turning_radps = [level](double t_s) { return 0.5 * level(t_s, 1); };
  return driven;
}

std::optional<PathLag> LagOf(const Driven& driven) {
  return LagBehind(driven.Path(), driven.Fixes(), kNear_s);
}

/// 1 without anything to compare.
double POf(const Driven& driven) {
  const auto lag = LagOf(driven);
  return lag ? lag->p : 1;
}

TEST(PathLag, IsFoundOverAMinuteToBothSides) {
  for (const double late_s : {-60.0, -18.0, -7.3, -1.2, 0.8, 3.0, 18.0, 37.4, 60.0}) {
    Driven driven = Restless(3);
    driven.length_s = 140;
    driven.late_s = late_s;
    const auto lag = LagOf(driven);
    ASSERT_TRUE(lag);
    EXPECT_NEAR(lag->lag_s, late_s, std::min(0.05, 5 * lag->sigma_s + 0.005));
    EXPECT_LT(lag->sigma_s, 0.02);
    EXPECT_LT(lag->p, kAlpha) << late_s;
    EXPECT_NEAR(lag->share, 1, 0.02);
    EXPECT_LT(lag->rms_after_m, 0.2 * lag->rms_before_m);
  }
}

TEST(PathLag, IsFoundThroughGapsAndSlip) {
  Driven driven = Restless(4);
  driven.late_s = -7.3;
  driven.share = 0.8;
  driven.gap_from_s = 20, driven.gap_to_s = 33;
  const auto lag = LagOf(driven);
  ASSERT_TRUE(lag);
  EXPECT_NEAR(lag->lag_s, -7.3, 0.02);
  EXPECT_NEAR(lag->share, 0.8, 0.02);
  EXPECT_LT(lag->p, kAlpha);
}

// Means over a second of ten fixes err by 0.6 m; the machine moves by half of that.
TEST(PathLag, IsFoundUnderNoiseOfTwoMetresWithinAnHour) {
  Driven driven = Restless(5);
  driven.length_s = 3600;
  driven.noise_m = 2;
  driven.late_s = 18;
  const auto lag = LagOf(driven);
  ASSERT_TRUE(lag);
  EXPECT_NEAR(lag->lag_s, 18, 5 * lag->sigma_s);
  EXPECT_LT(lag->p, kAlpha);
}

TEST(PathLag, IsFoundUnderNoiseOfThreeDecimetresWithinMinutes) {
  Driven driven = Restless(6);
  driven.length_s = 180;
  driven.noise_m = 0.3;
  driven.late_s = 18;
  const auto lag = LagOf(driven);
  ASSERT_TRUE(lag);
  EXPECT_NEAR(lag->lag_s, 18, 5 * lag->sigma_s);
  EXPECT_LT(lag->p, kAlpha);
}

TEST(PathLag, OfAClockThatIsRightIsNeverTold) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Driven driven = Restless(seed);
    driven.length_s = 20 + static_cast<double>(seed % 4) * 40;
    driven.noise_m = seed % 3 == 0 ? 2 : seed % 3 == 1 ? 0.3 : 0.01;
    EXPECT_GT(POf(driven), 0.05) << seed;
  }
}

/// Fixes of another path: the error is not the clock's.
TEST(PathLag, BetweenWaysThatHaveNothingInCommonIsSeldomTold) {
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Driven driven = Restless(seed), other = Restless(seed + 1000);
    driven.length_s = other.length_s = 20 + static_cast<double>(seed % 4) * 40;
    const auto lag = LagBehind(driven.Path(), other.Fixes(), kNear_s);
    told += lag && lag->p <= kAlpha && lag->share > 0.5 && lag->share < 1.5;
  }
  EXPECT_EQ(told, 0);
}

TEST(PathLag, IsNoneAtAStandstill) {
  Driven driven = Restless(1);
  driven.speed_mps = [](double) { return 0.0; };
  driven.noise_m = 2;
  EXPECT_FALSE(LagOf(driven));
}

TEST(PathLag, IsNotToldOfASteadyDrive) {
  Driven driven = Restless(1);
  driven.speed_mps = [](double) { return 0.8; };
  driven.turning_radps = [](double) { return 0.1; };
  driven.late_s = 18;
  EXPECT_GT(POf(driven), 0.05);
}

// Strokes that repeat every ten seconds match at all multiples of that lag.
TEST(PathLag, IsNotToldWhereMotionRepeatsItself) {
  Driven driven = Restless(1);
  driven.speed_mps = [](double t_s) { return std::sin(2 * M_PI * t_s / 10); };
  driven.turning_radps = [](double) { return 0.0; };
  driven.late_s = 20;
  EXPECT_GT(POf(driven), 0.05);
}

TEST(PathLag, NeedsTimeInCommon) {
  Driven driven = Restless(1);
  driven.length_s = 30;
  driven.late_s = 200;
  EXPECT_FALSE(LagOf(driven));
}

}  // namespace
}  // namespace tera
