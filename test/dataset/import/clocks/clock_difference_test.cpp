#include "dataset/import/clocks/clock_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

// Artificial motions: bumps of random height, width and time, about one every three seconds. One
// channel observes them at 100 Hz with a correct clock. Another observes them at 50 Hz with a clock
// 3 s ahead that gains 50 ppm.

namespace tera {
namespace {

constexpr double kAhead_s = 3, kDrift = 50e-6;

class Bumps {
 public:
  Bumps(unsigned seed, double duration_s) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> height(-0.5, 0.5), width(0.3, 1.0), gap(1, 5);
    for (double t_s = gap(random); t_s < duration_s; t_s += gap(random)) {
      bumps_.push_back({t_s, height(random), width(random)});
    }
  }

  double At(double t_s) const {
    double sum = 0;
    for (const Bump& b : bumps_) {
      const double u = (t_s - b.t_s) / b.width_s;
      if (std::abs(u) < 6) sum += b.height * std::exp(-0.5 * u * u);
    }
    return sum;
  }

 private:
  struct Bump {
    double t_s, height, width_s;
  };
  std::vector<Bump> bumps_;
};

struct Clock {
  double ahead_s = 0, drift = 0;
  TimeNs Stamp(double t_s) const { return FromSeconds(t_s * (1 + drift) + ahead_s); }
};

constexpr double kDuration_s = 300;

/// A gyro that turns about its y with the motion, and trembles about all axes.
ChannelMotion Gyro(const Bumps& motion, const Clock& clock, unsigned seed, double sign = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.02);
  std::vector<ImuSample> samples;
  for (int k = 0; k < kDuration_s * 100; ++k) {
    const double t_s = 0.01 * k;
    ImuSample s;
    s.t_ns = clock.Stamp(t_s);
    s.w_WS_S_radps = Vec3(noise(random), sign * motion.At(t_s) + noise(random), noise(random));
    samples.push_back(s);
  }
  return {
      "digger/imu", "gyro", 0.01,
      MotionOf(samples.size(), SampleOfRow<ImuSample>([&](std::size_t i) { return samples[i]; }))};
}

/// Encoders of the joint that moves and of one that has its own motion.
ChannelMotion Encoder(const Bumps& motion, const Bumps& other, const Clock& clock, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.02);
  std::vector<EncoderSample> samples;
  for (int k = 0; k < kDuration_s * 50; ++k) {
    const double t_s = 0.02 * k;
    samples.push_back({clock.Stamp(t_s),
                       0,
                       {0, 0},
                       {other.At(t_s) + noise(random), motion.At(t_s) + noise(random)}});
  }
  return {"digger/joints", "encoder", 0.02, MotionOf({{"slew"}, {"boom"}}, samples)};
}

TEST(ClockDifference, AnOffsetAndADriftAreFoundWithinTheirBounds) {
  int within_offset = 0, within_drift = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Bumps motion(seed, kDuration_s), other(seed + 500, kDuration_s);
    const auto found = ClockDifferences(
        {Gyro(motion, {}, seed + 100, -1), Encoder(motion, other, {kAhead_s, kDrift}, seed + 200)});
    ASSERT_EQ(found.size(), 1u) << seed;
    EXPECT_EQ(found[0].channel, "digger/joints");
    EXPECT_EQ(found[0].reference, "digger/imu");
    EXPECT_EQ(found[0].what, "boom");
    EXPECT_EQ(found[0].reference_what, "wy");
    const double expected_s = kAhead_s + kDrift * (ToSeconds(found[0].from_ns) - kAhead_s);
    within_offset += std::abs(found[0].ahead_s - expected_s) <= found[0].ahead_bound_s;
    within_drift += std::abs(found[0].drift - kDrift) <= found[0].drift_bound;
    EXPECT_LT(found[0].ahead_bound_s, 0.02);
    EXPECT_LT(found[0].drift_bound, 60e-6);
    EXPECT_GE(found[0].stretches, 8);
  }
  // In 98 of 100 such series, at least 17 of twenty intervals of 95 % hold.
  EXPECT_GE(within_offset, 17);
  EXPECT_GE(within_drift, 17);
}

TEST(ClockDifference, ClocksThatAgreeAreNotMentioned) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Bumps motion(seed, kDuration_s), other(seed + 500, kDuration_s);
    const ChannelMotion gyro = Gyro(motion, {}, seed + 100);
    const ChannelMotion encoder = Encoder(motion, other, {}, seed + 200);
    EXPECT_TRUE(CompareClocks(gyro, encoder)) << seed;
    EXPECT_TRUE(ClockDifferences({gyro, encoder}).empty()) << seed;
  }
}

TEST(ClockDifference, OfDifferentMotionsNothingIsSaid) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Bumps motion(seed, kDuration_s), one(seed + 500, kDuration_s),
        another(seed + 900, kDuration_s);
    EXPECT_FALSE(CompareClocks(Gyro(motion, {}, seed + 100),
                               Encoder(one, another, {kAhead_s, kDrift}, seed + 200)))
        << seed;
  }
}

// Noise alone, and a motion that repeats every four seconds, which fits at every fourth.
TEST(ClockDifference, OfNoMotionAndOfOneThatRepeatsNothingIsSaid) {
  const Bumps none(1, 0);
  EXPECT_FALSE(CompareClocks(Gyro(none, {}, 1), Encoder(none, none, {}, 2)));
  std::vector<EncoderSample> samples;
  for (int k = 0; k < 10000; ++k) {
    const double t_s = 0.02 * k;
    samples.push_back({FromSeconds(t_s), 0, {0}, {std::sin(t_s * 1.5708)}});
  }
  const ChannelMotion a{"a", "a", 0.02, MotionOf({{"boom"}}, samples)};
  const ChannelMotion b{"b", "b", 0.02, MotionOf({{"boom"}}, samples)};
  EXPECT_FALSE(CompareClocks(a, b));
}

TEST(ClockDifference, ChannelsOfOneClockAreNotCompared) {
  const Bumps motion(1, kDuration_s), other(2, kDuration_s);
  ChannelMotion gyro = Gyro(motion, {}, 3), encoder = Encoder(motion, other, {kAhead_s}, 4);
  encoder.clock = gyro.clock;
  EXPECT_TRUE(ClockDifferences({gyro, encoder}).empty());
}

// A receiver at 5 Hz on a vehicle with the gyro's turns, at 2 m/s; its clock is 1.2 s behind.
TEST(ClockDifference, AReceiversCourseTellsOfAGyrosClock) {
  const Bumps motion(5, kDuration_s);
  std::mt19937 random(6);
  std::normal_distribution<double> noise(0, 0.005);
  std::vector<GnssSample> fixes;
  double yaw_rad = 0;
  Vec3 p_m = Vec3::Zero();
  for (int k = 0; k < kDuration_s * 100; ++k) {
    const double t_s = 0.01 * k;
    if (k % 20 == 0) {
      GnssSample fix;
      fix.t_ns = FromSeconds(t_s - 1.2);
      fix.fix = GnssFix::kRtkFixed;
      fix.enu_m = p_m + Vec3(noise(random), noise(random), 0);
      fixes.push_back(fix);
    }
    yaw_rad += 0.01 * motion.At(t_s);
    p_m += 0.02 * Vec3(std::cos(yaw_rad), std::sin(yaw_rad), 0);
  }
  const ChannelMotion receiver{"rover/gnss", "gnss", 0.2, MotionOf(fixes)};
  const auto found = ClockDifferences({Gyro(motion, {}, 7), receiver});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].what, "course rate");
  EXPECT_NEAR(found[0].ahead_s, -1.2, found[0].ahead_bound_s);
  EXPECT_LE(std::abs(found[0].drift), 2 * found[0].drift_bound);
}

// A row a thousand years later must not create a grid beyond the memory, and few rows not an empty
// one.
TEST(MotionSeries, GridsAreBounded) {
  std::vector<EncoderSample> samples;
  for (int k = 0; k < 200; ++k) samples.push_back({k * 10'000'000, 0, {0}, {1.0}});
  samples.push_back({9'000'000'000'000'000'000, 0, {0}, {1.0}});
  for (const MotionSeries& series : MotionOf({{"boom"}}, samples)) {
    EXPECT_LE(series.values.size(), 1'000'002u);
  }
  samples.resize(50);
  EXPECT_TRUE(MotionOf({{"boom"}}, samples).empty());
}

}  // namespace
}  // namespace tera
