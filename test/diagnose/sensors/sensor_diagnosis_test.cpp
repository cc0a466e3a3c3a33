#include "diagnose/sensors/sensor_diagnosis.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/sensors/made_recording.h"
#include "diagnose/sensors/usual_tolerances.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const UsualTolerances kTolerances;

SensorDiagnosis Diagnosed(MadeRecording* made) {
  StageClock clock;
  return DiagnoseSensors(made->Input(), made->measured, {}, &clock);
}

std::vector<std::string> NamesOf(const std::vector<SensorFinding>& findings) {
  std::vector<std::string> names;
  for (const SensorFinding& finding : findings) {
    names.push_back(finding.Name());
  }
  return names;
}

/// A single error and its expected report.
struct Case {
  Wrong wrong;
  std::string name, number;
  double value = 0;  ///< in the mechanism's unit
};

/// Four times the tolerance. Eight times for the place of the unit and for a reflection, sixteen
/// times for an accelerometer's bias, of which a minute reveals little next to a tilt within
/// tolerance.
std::vector<Case> Cases() {
  const UsualTolerances& of = kTolerances;
  std::vector<Case> cases(8);
  cases[0] = {{}, "imu_boom/bias", "gyro_y_degps", 4 * of.gyro_bias_radps / kDeg};
  cases[0].wrong.gyro_bias_radps.y() = 4 * of.gyro_bias_radps;
  cases[1] = {{}, "imu_boom/bias", "accel_x_mps2", -16 * of.accel_bias_mps2};
  cases[1].wrong.accel_bias_mps2.x() = -16 * of.accel_bias_mps2;
  cases[2] = {{}, "imu_boom/mount_rotation", "roll_deg", 4 * of.unit_mount_rad / kDeg};
  cases[2].wrong.mount_rad.x() = 4 * of.unit_mount_rad;
  cases[3] = {{}, "imu_boom/imu_lever_arm", "y_m", 8 * of.unit_place_m};
  cases[3].wrong.place_m.y() = 8 * of.unit_place_m;
  cases[4] = {{}, "left/gnss_lever_arm", "y_m", -4 * of.antenna_place_m};
  cases[4].wrong.antenna_place_m.y() = -4 * of.antenna_place_m;
  cases[5] = {{}, "left/gnss_lever_arm", "x_m", 4 * of.antenna_place_m};
  cases[5].wrong.antenna_place_m.x() = 4 * of.antenna_place_m;
  cases[6] = {{}, "imu_boom/clock_offset", "offset_s", 4 * of.stamps_s};
  cases[6].wrong.unit_late_s = 4 * of.stamps_s;
  cases[7] = {{}, "left/multipath", "horizontal_m", 8 * of.reflected_m};
  cases[7].wrong.reflected_m = 8 * of.reflected_m;
  return cases;
}

/// Each finding with its numbers, for messages.
std::string Told(const SensorDiagnosis& diagnosis) {
  std::string text;
  std::vector<SensorFinding> all = diagnosis.findings;
  all.insert(all.end(), diagnosis.unproven.begin(), diagnosis.unproven.end());
  all.insert(all.end(), diagnosis.within_tolerance.begin(), diagnosis.within_tolerance.end());
  for (const SensorFinding& finding : all) {
    text += fmt::format("\n{}, gain {:.1f}, p {:.2g}:", finding.Name(), finding.gain, finding.p);
    for (const FoundNumber& number : finding.numbers) {
      text += fmt::format(" {} {:.4g} +- {:.2g}", number.name, number.value, number.sigma);
    }
    for (const TargetMechanism& rival : finding.rivals) text += ", or " + rival.Name();
  }
  return text;
}

void ExpectNamed(const Case& wrong, const SensorDiagnosis& told) {
  ASSERT_THAT(NamesOf(told.findings), ElementsAre(wrong.name)) << wrong.number << Told(told);
  SCOPED_TRACE(Told(told));
  bool is_there = false;
  for (const FoundNumber& number : told.findings[0].numbers) {
    const bool is_wrong = number.name == wrong.number;
    is_there |= is_wrong;
    if (is_wrong) {
      EXPECT_NEAR(number.value, wrong.value, 3 * number.sigma) << number.name;
      EXPECT_TRUE(number.is_beyond) << number.name;
      EXPECT_LT(number.sigma, 0.5 * std::abs(wrong.value)) << number.name;
    } else {
      EXPECT_NEAR(number.value, number.documented, std::max(4 * number.sigma, number.tolerance))
          << number.name;
      EXPECT_FALSE(number.is_beyond) << number.name;
    }
  }
  EXPECT_TRUE(is_there) << wrong.number;
}

class OneWrong : public ::testing::TestWithParam<int> {};

TEST_P(OneWrong, IsNamedWithItsNumber) {
  const Case wrong = Cases()[GetParam()];
  MadeRecording made({.wrong = wrong.wrong});
  ExpectNamed(wrong, Diagnosed(&made));
}

TEST_P(OneWrong, IsNamedThoughRowsAreLostAndStampsJitter) {
  const Case wrong = Cases()[GetParam()];
  MadeRecording made({.wrong = wrong.wrong, .seed = 2, .lost = 0.1, .jitter_s = 0.003});
  ExpectNamed(wrong, Diagnosed(&made));
}

INSTANTIATE_TEST_SUITE_P(SensorDiagnosis, OneWrong, ::testing::Range(0, 8), [](const auto& info) {
  std::string name = Cases()[info.param].name + "_" + Cases()[info.param].number;
  for (char& c : name) c = std::isalnum(c) ? c : '_';
  return name;
});

TEST(SensorDiagnosis, OfNothingWrongNamesNothing) {
  for (const std::uint64_t seed : {11, 12, 13, 14}) {
    MadeRecording made({.seed = seed});
    const SensorDiagnosis told = Diagnosed(&made);
    EXPECT_THAT(NamesOf(told.findings), IsEmpty()) << seed;
    EXPECT_FALSE(told.motion.empty());
  }
}

Effect OfUnit(std::string_view id, std::vector<double> values) {
  return {&SensorMechanism(id, EffectTarget::kImu), std::move(values)};
}

// Errors far beyond tolerance, all documented in the scenario.
TEST(SensorDiagnosis, OfErrorsThatAreDocumentedNamesNothing) {
  MadeRecording made({.wrong = {.gyro_bias_radps = {0.01, -0.02, 0.03},
                                .accel_bias_mps2 = {0.3, -0.2, 0.4},
                                .mount_rad = {0.2, -0.3, 0.4},
                                .place_m = {0.5, 0.6, -0.4},
                                .unit_late_s = 0.12},
                      .seed = 15});
  made.input.sensors[1].effects = {
      OfUnit("bias", {0.01 / kDeg, -0.02 / kDeg, 0.03 / kDeg, 0.3, -0.2, 0.4}),
      OfUnit("mount_rotation", {0.2 / kDeg, -0.3 / kDeg, 0.4 / kDeg}),
      OfUnit("imu_lever_arm", {0.5, 0.6, -0.4}), OfUnit("clock_offset", {0.12})};
  EXPECT_THAT(NamesOf(Diagnosed(&made).findings), IsEmpty());
  // Without their documentation, all are wrong.
  made.input.sensors[1].effects.clear();
  EXPECT_FALSE(Diagnosed(&made).findings.empty());
}

TEST(SensorDiagnosis, NamesAClockThatIsElevenHundredthsLate) {
  MadeRecording made({.wrong = {.unit_late_s = 0.11}, .seed = 16});
  ExpectNamed({{}, "imu_boom/clock_offset", "offset_s", 0.11}, Diagnosed(&made));
}

// A filter weakens what it delays: neither a clock nor scales are at fault.
TEST(SensorDiagnosis, NamesALowPassAndNoClockOrScale) {
  MadeRecording made({.wrong = {.unit_low_pass_s = 0.2}, .seed = 18});
  const SensorDiagnosis told = Diagnosed(&made);
  ASSERT_THAT(NamesOf(told.findings), ElementsAre("imu_boom/filter_delay")) << Told(told);
  // Samples are filtered one by one, and so lag by half a sample less than a continuous filter's. A
  // scale within its tolerance weakens as some of the filter does.
  EXPECT_NEAR(told.findings[0].numbers[0].value, 0.19, 0.02);
}

TEST(SensorDiagnosis, NamesTheRangeOfAGyroThatTheMotionExceeds) {
  MadeRecording made({.wrong = {.gyro_limit_radps = 0.35}, .seed = 20});
  ExpectNamed({{}, "imu_boom/saturation", "gyro_limit_degps", 0.35 / kDeg}, Diagnosed(&made));
}

TEST(SensorDiagnosis, TakesADocumentedRangeIntoAccount) {
  MadeRecording made({.wrong = {.gyro_limit_radps = 0.35}, .seed = 20});
  made.input.sensors[1].effects = {OfUnit("saturation", {0.35 / kDeg, 100})};
  EXPECT_THAT(NamesOf(Diagnosed(&made).findings), IsEmpty());
}

TEST(SensorDiagnosis, NamesALowPassThatIsLongerThanDocumented) {
  MadeRecording made({.wrong = {.unit_low_pass_s = 0.3}, .seed = 21});
  made.input.sensors[1].effects = {OfUnit("filter_delay", {0.1})};
  const SensorDiagnosis told = Diagnosed(&made);
  ASSERT_THAT(NamesOf(told.findings), ElementsAre("imu_boom/filter_delay")) << Told(told);
  EXPECT_NEAR(told.findings[0].numbers[0].value, 0.29, 0.03);
}

// A mechanism that a library leaves out takes nothing from the others.
TEST(SensorDiagnosis, TriesOnlyMechanismsOfTheLibrary) {
  MadeRecording made({.wrong = {.unit_low_pass_s = 0.2}, .seed = 18});
  StageClock clock;
  const SensorDiagnosis told = DiagnoseSensors(
      made.Input(), made.measured, {.library = CandidateLibrary{.only = {"clock_offset"}}}, &clock);
  EXPECT_THAT(NamesOf(told.findings), ElementsAre("imu_boom/clock_offset"));
}

TEST(SensorDiagnosis, TakesADocumentedLowPassIntoAccount) {
  MadeRecording made({.wrong = {.unit_low_pass_s = 0.2}, .seed = 19});
  made.input.sensors[1].effects = {OfUnit("filter_delay", {0.2})};
  EXPECT_THAT(NamesOf(Diagnosed(&made).findings), IsEmpty());
}

TEST(SensorDiagnosis, NamesAGyroAxisThatIsReversedAlone) {
  MadeRecording made({.wrong = {.gyro_x_reversed = true}, .seed = 17});
  const SensorDiagnosis told = Diagnosed(&made);
  ASSERT_THAT(NamesOf(told.findings), ElementsAre("imu_boom/axis_flip")) << Told(told);
  ASSERT_EQ(told.findings[0].numbers.size(), 1u);
  EXPECT_EQ(told.findings[0].numbers[0].name, "gyro_x");
  EXPECT_EQ(told.findings[0].numbers[0].value, 1);
}

// The swing reverses within 5 ms, which splines with knots 50 ms apart cannot follow.
TEST(SensorDiagnosis, OfBlowsThatNoSplineFollowsNamesNothing) {
  for (const double blows_radps : {0.2, 0.6}) {
    MadeRecording made({.seed = 18, .slew_moves = 0.3, .blows_radps = blows_radps});
    const SensorDiagnosis told = Diagnosed(&made);
    EXPECT_THAT(NamesOf(told.findings), IsEmpty()) << blows_radps << Told(told);
  }
}

// An acceleration that all units behind a joint feel alike is not the scale of any of them.
TEST(SensorDiagnosis, OfAnAccelerationThatAllUnitsHaveTooLargeNamesNothing) {
  for (const double more : {0.045, -0.03}) {
    MadeRecording made({.seed = 23, .swing_accelerates_more = more});
    const SensorDiagnosis told = Diagnosed(&made);
    EXPECT_THAT(NamesOf(told.findings), IsEmpty()) << more << Told(told);
  }
}

// Two units far from the swing's axis distinguish the scale of one from the gain of both.
TEST(SensorDiagnosis, NamesTheScaleOfOneUnitBesideAnAccelerationThatAllHaveTooLarge) {
  MadeRecording made({.wrong = {.accel_scale = {1, 1.08, 1}},
                      .seed = 24,
                      .swing_accelerates_more = 0.045,
                      .upper_unit_x_m = -2});
  ExpectNamed({{}, "imu_boom/scale", "accel_y_factor", 1.08}, Diagnosed(&made));
}

TEST(SensorDiagnosis, TwoAntennasOneAboveTheOtherHaveNoYaw) {
  MadeRecording made({.seed = 25});
  made.input.sensors[3].X_BS = made.input.sensors[2].X_BS;
  made.input.sensors[3].X_BS.translation().z() += 0.5;
  for (const TargetMechanism& one : Diagnosed(&made).estimated) {
    EXPECT_NE(one.mechanism->id, "antenna_yaw");
  }
}

// Nothing turns a unit about its mount, so that only the waves reveal its place.
TEST(SensorDiagnosis, OfWavesUnderAMachineWhoseJointsRestNamesNothing) {
  for (const bool has_poses : {true, false}) {
    MadeRecording made({.seed = 19, .slew_moves = 0, .boom_moves = 0, .has_poses = has_poses});
    const SensorDiagnosis told = Diagnosed(&made);
    EXPECT_THAT(NamesOf(told.findings), IsEmpty()) << Told(told);
  }
}

TEST(SensorDiagnosis, OfNothingWrongButLostRowsAndJitterNamesNothing) {
  for (const std::uint64_t seed : {21, 22}) {
    MadeRecording made({.seed = seed, .lost = 0.2, .jitter_s = 0.004});
    EXPECT_THAT(NamesOf(Diagnosed(&made).findings), IsEmpty()) << seed;
  }
}

/// A machine that stands and raises its boom, with a bias of the boom's gyro about z. Only the boom
/// has an encoder, and no receiver or pose observes the base. Levers at 10 Hz show that neither
/// tracks nor swing move.
MadeRecording StandingByItsLevers(double gyro_z_radps) {
  Wrong wrong;
  wrong.gyro_bias_radps.z() = gyro_z_radps;
  MadeRecording made({.wrong = wrong, .base_moves = 0, .slew_moves = 0, .has_poses = false});
  for (auto& samples : made.measured.gnss) samples.clear();
  EncoderRecording& encoders = made.measured.encoders[0].recording;
  encoders.axes.erase(encoders.axes.begin());
  for (EncoderSample& sample : encoders.samples) {
    sample.q_rad.erase(sample.q_rad.begin());
    sample.qd_radps.erase(sample.qd_radps.begin());
  }
  made.model.ground_tools.gears.resize(2);
  made.model.levers.push_back({"left_track", -1, 0});
  made.model.levers.push_back({"right_track", -1, 1});
  made.input.commands.columns = {"swing", "left_track", "right_track"};
  for (int k = 0; k <= 400; ++k) {
    made.input.commands.t_ns.push_back(FromSeconds(0.1 * k));
    made.input.commands.rows.push_back({0, 0, 0});
  }
  return made;
}

// Without the levers, a place of the boom's unit 0.46 m off would be named too.
TEST(SensorDiagnosis, KnowsByLeversThatABaseWithoutSensorsStands) {
  const double bias_radps = 8 * kTolerances.gyro_bias_radps;
  MadeRecording made = StandingByItsLevers(bias_radps);
  ExpectNamed({{}, "imu_boom/bias", "gyro_z_degps", bias_radps / kDeg}, Diagnosed(&made));
}

TEST(SensorDiagnosis, FindsTheMotionThatWas) {
  MadeRecording made({.seed = 31});
  const SensorDiagnosis told = Diagnosed(&made);
  int looked_at = 0;
  for (const EstimatedMotion& motion : told.motion) {
    EXPECT_GE(motion.start_ns, 0) << "all was observed from then on";
    EXPECT_LE(motion.end_ns, 40 * kNsPerSecond) << "all was observed until then";
    for (TimeNs t_ns = motion.start_ns; t_ns <= motion.end_ns; t_ns += 370'000'000) {
      const Pose X_WB = made.Base(ToSeconds(t_ns)), found = motion.BaseAt(t_ns);
      // Within the tolerance of places, 0.04 m, and of clocks, 0.04 s at 1.5 m/s.
      EXPECT_LT((found.translation() - X_WB.translation()).norm(), 0.1) << t_ns;
      EXPECT_LT(Eigen::AngleAxisd(found.linear().transpose() * X_WB.linear()).angle(), 0.06);
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 90) << "of 40 s";
}

}  // namespace
}  // namespace tera
