#include "diagnose/sensors/diagnosed_sensors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/report/text/sensor_text.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A unit turned by 2 deg, known to 0.1 deg, with an encoder's zero as rival.
SensorDiagnosis TurnedUnit() {
  SensorDiagnosis made;
  SensorFinding turned{{"imu_boom", &SensorMechanism("mount_rotation", EffectTarget::kImu)},
                       {},
                       120,
                       1e-6,
                       {{"encoders/boom", &SensorMechanism("bias", EffectTarget::kEncoderAxis)}}};
  turned.numbers = {{"roll_deg", "deg", 2, 0.1, 0, 0.46, true},
                    {"pitch_deg", "deg", 0.01, 0.1, 0, 0.46, false},
                    {"yaw_deg", "deg", 0, 0.1, 0, 0.46, false}};
  made.findings = {turned};
  made.channels = {{.name = "m/imu_boom/wx_radps",
                    .unit = "rad/s",
                    .noise = 0.01,
                    .differences = 0.01,
                    .rms_before = 0.012,
                    .rms_after = 0.011},
                   {.name = "m/imu_boom/ay_mps2",
                    .unit = "m/s^2",
                    .noise = 0.1,
                    .differences = 0.1,
                    .rms_before = 0.5,
                    .rms_after = 0.1},
                   {.name = "m/imu_arm/wx_radps",
                    .unit = "rad/s",
                    .noise = 0.01,
                    .differences = 0.01,
                    .rms_before = 0.03,
                    .rms_after = 0.03}};
  return made;
}

TEST(DiagnosedSensors, HaveTheNumbersOfTheMechanismAndTheChannelInWhichTheyShowMost) {
  const DiagnosedSensors told = DiagnosedOf(TurnedUnit(), "m");
  ASSERT_THAT(told.findings, SizeIs(1));
  const Finding& finding = told.findings[0].finding;
  EXPECT_EQ(finding.term.candidate->mechanism->id, "mount_rotation");
  EXPECT_EQ(finding.term.candidate->target, "imu_boom");
  EXPECT_THAT(finding.term.values, ElementsAre(2, 0.01, 0));
  EXPECT_EQ(finding.parameters[0].sigma, 0.1);
  EXPECT_EQ(told.findings[0].channel, "m/imu_boom/ay_mps2");
  EXPECT_EQ(told.findings[0].unit, "m/s^2");
  // The whole excess of the mean square, 0.25 - 0.01, is gone.
  EXPECT_NEAR(finding.held_out.excess_removed, 1, 1e-9);
  ASSERT_THAT(finding.evidence.rivals, SizeIs(2));
  EXPECT_EQ(finding.evidence.rivals[1]->target, "encoders/boom");
  EXPECT_EQ(finding.evidence.rivals[1]->mechanism->id, "bias");
}

// Inertial units also have a bias, distinct from an encoder's and with other parameters.
TEST(DiagnosedSensors, RivalOfAnEncoderIsTheEncodersMechanismAndNotAUnitsOfTheSameName) {
  const DiagnosedSensors told = DiagnosedOf(TurnedUnit(), "m");
  const Candidate& rival = *told.findings[0].finding.evidence.rivals[1];
  EXPECT_TRUE(rival.mechanism->ActsOn(EffectTarget::kEncoderAxis));
  EXPECT_FALSE(rival.mechanism->ActsOn(EffectTarget::kImu));
  EXPECT_THAT(rival.mechanism->parameters, Contains(Field(&EffectParameter::name, "angle_deg")));
  EXPECT_THAT(SentenceOf(told.findings[0]), HasSubstr("bias of the encoders"));
}

TEST(DiagnosedSensors, UnitThatTheMotionFollowsIsShownByWhatBearsItsError) {
  SensorDiagnosis made = TurnedUnit();
  // The motion follows the unit despite its error; the poses differ from it.
  made.channels = {{.name = "m/imu_boom/wx_radps",
                    .unit = "rad/s",
                    .noise = 0.001,
                    .rms_before = 0.00001,
                    .rms_after = 0.001},
                   {.name = "m/poses/roll_rad",
                    .unit = "rad",
                    .noise = 0.01,
                    .rms_before = 0.05,
                    .rms_after = 0.012}};
  const DiagnosedSensors told = DiagnosedOf(made, "m");
  ASSERT_THAT(told.findings, SizeIs(1));
  EXPECT_EQ(told.findings[0].channel, "m/poses/roll_rad");
  EXPECT_EQ(told.findings[0].finding.held_out.rmse_before, 0.05);
  EXPECT_EQ(told.findings[0].finding.held_out.rmse_after, 0.012);
}

TEST(DiagnosedSensors, AreListedOnceEach) {
  EXPECT_THAT(ComparedSensors(DiagnosedOf(TurnedUnit(), "m")), ElementsAre("imu boom", "imu arm"));
}

TEST(DiagnosedSensors, AreToldInASentenceWithNumbersRivalsAndErrors) {
  const DiagnosedSensors told = DiagnosedOf(TurnedUnit(), "m");
  ASSERT_THAT(told.findings, SizeIs(1));
  const std::string sentence = SentenceOf(told.findings[0]);
  EXPECT_THAT(sentence, HasSubstr("Mount rotation roll 2.00 ± 0.10 deg"));
  EXPECT_THAT(sentence, HasSubstr("of the imu boom, beyond tolerance"));
  EXPECT_THAT(sentence, HasSubstr("bias of the encoders"));
  EXPECT_THAT(sentence, HasSubstr("Imu boom specific force along y: RMSE 0.5 → 0.1 m/s²"));
}

// Residuals that persist at three times their successive differences, but within the tolerance of a
// bias, or a tenth of the unit's motion.
TEST(DiagnosedSensors, AreNotWrongForWhatIsWithinToleranceOrSmallBesideTheirMotion) {
  ChannelError error{.differences = 0.01, .rms_after = 0.03};
  EXPECT_FALSE(IsNoise(error));
  EXPECT_FALSE(IsExplained(error));
  error.tolerance = 0.04;
  EXPECT_TRUE(IsExplained(error));
  error.tolerance = 0;
  error.motion = 0.3;
  EXPECT_TRUE(IsExplained(error));
  error.motion = 0.1;
  EXPECT_FALSE(IsExplained(error));
}

// 0.03 rad/s of the arm's unit are three times its residuals' successive differences: other blocks
// must examine it. The boom's residual is explained.
TEST(DiagnosedSensors, LeaveToOthersTheSensorsWhoseErrorLasts) {
  SensorDescription boom, arm;
  boom.name = "imu_boom";
  arm.name = "imu_arm";
  DiagnosisInput input;
  input.machine = "m";
  input.sensors = {boom, arm};
  Measurements measured;
  measured.imus = {{ImuSample{}}, {ImuSample{}}};
  measured.gnss = {{}, {}};
  const Measurements left = WithoutExplained(input, TurnedUnit(), measured);
  EXPECT_THAT(left.imus[0], SizeIs(0));
  EXPECT_THAT(left.imus[1], SizeIs(1));
}

}  // namespace
}  // namespace tera
