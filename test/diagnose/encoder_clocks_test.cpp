#include "diagnose/encoder_clocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/driven_joints.h"
#include "diagnose/search/toy_block.h"
#include "diagnose/sensors/named_clock.h"

namespace tera {
namespace {

constexpr std::size_t kSamples = 4000;  // of 0.01 s

/// A block whose noisy rate leads its lever by `ahead` samples, with a lag of 50 ms.
ReplayBlock Ahead(std::uint64_t seed, std::size_t ahead,
                  std::vector<std::size_t> candidates = {3}) {
  const std::vector<double> lever = ToyLever(kSamples + ahead, seed);
  const std::vector<double> response = ToyResponse(lever, 0, 0, 0.05);
  std::vector<double> heard, clean;
  for (std::size_t k = 0; k < kSamples; ++k) {
    heard.push_back(lever[k]);
    clean.push_back(response[k + ahead]);
  }
  return ToyBlock(heard, ToyMeasured(clean, 0.05, seed), candidates);
}

std::vector<ReplayBlock> Both(ReplayBlock a, ReplayBlock b) {
  std::vector<ReplayBlock> blocks;
  blocks.push_back(std::move(a));
  blocks.push_back(std::move(b));
  return blocks;
}

TEST(EncoderLead, IsHowFarTheClockIsOffLessWhatTheDriveLags) {
  const auto lead_s = EncoderLead_s(Both(Ahead(1, 25), Ahead(2, 25)));
  ASSERT_TRUE(lead_s);
  EXPECT_NEAR(*lead_s, 0.20, 0.03);
}

TEST(EncoderLead, IsNoneWhereDrivesOnlyLagOrOneOfThemDoes) {
  EXPECT_FALSE(EncoderLead_s(Both(Ahead(1, 0), Ahead(2, 0))));
  EXPECT_FALSE(EncoderLead_s(Both(Ahead(1, 25), Ahead(2, 0))));
}

TEST(EncoderLead, IsNoneOfOneJointAloneOrWithoutLevers) {
  std::vector<ReplayBlock> one;
  one.push_back(Ahead(1, 25));
  EXPECT_FALSE(EncoderLead_s(one));
  EXPECT_FALSE(EncoderLead_s(Both(Ahead(1, 25, {0}), Ahead(2, 25, {0}))));
}

/// Change of the encoders' stamps.
double StampedEarlierBy_s(DrivenJoints driven, const SensorDiagnosis& estimate) {
  Measurements measured = driven.made.measured;
  const bool has_changed =
      StampEncodersAnew(driven.made.Input(), estimate, {.threads = 1}, &measured);
  const auto first = [](const Measurements& one) {
    return one.encoders[0].recording.samples.front().t_ns;
  };
  const double earlier_s = ToSeconds(first(driven.made.measured) - first(measured));
  EXPECT_EQ(has_changed, earlier_s != 0);
  return earlier_s;
}

TEST(LateEncoders, AreStampedAnewWhereTheLeversBearItOut) {
  EXPECT_NEAR(StampedEarlierBy_s(DrivenJoints(false), NamedClock("encoders", kLate_s)), kLate_s,
              1e-9);
}

// All other sensors are then early, and joints follow without delay by the unchanged stamps.
TEST(LateEncoders, KeepTheirStampsWhereTheLeversShareTheirClock) {
  EXPECT_EQ(StampedEarlierBy_s(DrivenJoints(true), NamedClock("encoders", kLate_s)), 0);
}

TEST(LateEncoders, KeepTheirStampsWhereSomethingElseMayBeLateOrIs) {
  SensorDiagnosis either = NamedClock("encoders", kLate_s);
  either.findings[0].rivals = {{"imu_boom", &SensorMechanism("clock_offset", EffectTarget::kImu)}};
  EXPECT_EQ(StampedEarlierBy_s(DrivenJoints(false), either), 0);
  EXPECT_EQ(StampedEarlierBy_s(DrivenJoints(false), NamedClock("imu_boom", kLate_s)), 0);
}

}  // namespace
}  // namespace tera
