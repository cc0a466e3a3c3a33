#include "diagnose/sensors/reversed_axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/sensors/diagnosed_sensors.h"
#include "diagnose/sensors/made_recording.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::size_t kSwing = 0, kBoom = 1;

/// Levers that follow the rates of the joints, `sign` times for the boom.
TableRecording LeversOf(const MadeRecording& made, double sign) {
  TableRecording levers{{"boom", "swing"}, {}, {}};
  for (int k = 0; k < 2000; ++k) {
    const double t = 0.02 * k;
    const auto now = made.Joints(t), before = made.Joints(t - 0.02);
    levers.t_ns.push_back(FromSeconds(t));
    levers.rows.push_back(
        {sign * (now[kBoom] - before[kBoom]) / 0.02, (now[kSwing] - before[kSwing]) / 0.02});
  }
  return levers;
}

/// The effect of an encoder axis with inverted sign.
Effect Flip() {
  for (const Mechanism& mechanism : SensorMechanisms()) {
    if (mechanism.id == "axis_flip" && mechanism.parameters.empty()) return {&mechanism, {}};
  }
  return {};
}

/// A recording in which the boom's encoder reads 2 pivot - q.
struct Recorded {
  MadeRecording made;
  explicit Recorded(std::optional<double> pivot_rad, double lever_sign = 1) : made(Made{}) {
    made.input.commands = LeversOf(made, lever_sign);
    if (!pivot_rad) return;
    for (EncoderSample& sample : made.measured.encoders[0].recording.samples) {
      sample.q_rad[kBoom] = 2 * *pivot_rad - sample.q_rad[kBoom];
      sample.qd_radps[kBoom] = -sample.qd_radps[kBoom];
    }
  }
};

TEST(ReversedAxes, AreThoseThatCountAgainstUnitsAndLever) {
  Recorded recorded(0);
  const auto reversed = ReversedAxesOf(recorded.made.Input(), recorded.made.measured);
  ASSERT_THAT(reversed, SizeIs(1));
  EXPECT_EQ(reversed[0].target, "encoders/boom");
  EXPECT_LT(reversed[0].with_units, -0.9);
  EXPECT_LT(reversed[0].with_lever, -0.9);
  EXPECT_LT(reversed[0].p, 1e-6);
  EXPECT_FALSE(reversed[0].is_documented);
  EXPECT_LT(reversed[0].rms_after_radps, 0.3 * reversed[0].rms_before_radps);
}

TEST(ReversedAxes, AreNoneWhereAllCountForwards) {
  Recorded recorded(std::nullopt);
  EXPECT_THAT(ReversedAxesOf(recorded.made.Input(), recorded.made.measured), IsEmpty());
}

// A lever with a wrong sign contradicts encoder and unit: the encoder is right.
TEST(ReversedAxes, AreNotThoseWhoseLeverAloneGoesAgainstThem) {
  Recorded recorded(std::nullopt, -1);
  EXPECT_THAT(ReversedAxesOf(recorded.made.Input(), recorded.made.measured), IsEmpty());
}

// An inverted unit contradicts encoder and lever: the encoder is right.
TEST(ReversedAxes, AreNotThoseWhoseUnitAloneGoesAgainstThem) {
  Recorded recorded(std::nullopt);
  for (ImuSample& sample : recorded.made.measured.imus[1]) sample.w_WS_S_radps *= -1;
  EXPECT_THAT(ReversedAxesOf(recorded.made.Input(), recorded.made.measured), IsEmpty());
}

TEST(ReversedAxes, NeedUnitsOnBothSides) {
  Recorded recorded(0);
  recorded.made.measured.imus[0].clear();
  EXPECT_THAT(ReversedAxesOf(recorded.made.Input(), recorded.made.measured), IsEmpty());
}

TEST(ReversedAxes, CountForwardsAboutTheMiddleOfTheTravelWhereThatIsNearerToTheStart) {
  for (const double middle_rad : {0.0, 0.9}) {
    Recorded recorded(middle_rad);
    Joint& boom = recorded.made.model.joints[kBoom];
    boom.lower_rad = 0.9 - 1.4, boom.upper_rad = 0.9 + 1.4;
    boom.initial_rad = recorded.made.Joints(0)[kBoom] + 0.02;
    Measurements measured = recorded.made.measured;
    CountForwards(ReversedAxesOf(recorded.made.Input(), measured), &measured);
    for (const EncoderSample& sample : measured.encoders[0].recording.samples) {
      // Noise of 0.5 mrad, six standard deviations.
      ASSERT_NEAR(sample.q_rad[kBoom], recorded.made.Joints(ToSeconds(sample.t_ns))[kBoom], 0.003);
    }
  }
}

TEST(ReversedAxes, OfWhichTheScenarioSaysSoCountForwardsAndAreNoFinding) {
  Recorded recorded(0);
  for (const bool is_documented : {false, true}) {
    if (is_documented) {
      recorded.made.input.sensors[4].axis_effects["boom"] = {Flip()};
    }
    const auto reversed = ReversedAxesOf(recorded.made.Input(), recorded.made.measured);
    ASSERT_THAT(reversed, SizeIs(1));
    EXPECT_EQ(reversed[0].is_documented, is_documented);
    DiagnosedSensors told;
    AddReversed(reversed, &told);
    ASSERT_THAT(told.findings, SizeIs(is_documented ? 0 : 1));
    if (is_documented) continue;
    EXPECT_EQ(told.findings[0].finding.term.candidate->mechanism->id, "axis_flip");
    EXPECT_EQ(told.findings[0].channel, "m/encoders/boom_radps");
    EXPECT_EQ(told.findings[0].finding.evidence.p, reversed[0].p);
  }
}

}  // namespace
}  // namespace tera
