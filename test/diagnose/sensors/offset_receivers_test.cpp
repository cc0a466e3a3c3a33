#include "diagnose/sensors/offset_receivers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/sensors/diagnosed_sensors.h"
#include "diagnose/sensors/made_recording.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::size_t kLeft = 0, kRight = 1;

/// Motion of a tracked machine, and the errors of its receivers.
struct Tracked {
  double drives = 1, slews = 1;  ///< times the usual
  double slip = 0;
  double left_late_s = 0, right_late_s = 0;
  double noise_m = 0.01;
  double duration_s = 75;
  std::string link = "upper";
  bool has_right = true;
};

/// A machine with two tracks and a swing, two antennas, and encoders of all axes. Its tracks and
/// swing start, stop and turn anew every few seconds.
class TrackedRecording {
 public:
  explicit TrackedRecording(const Tracked& how) : model(TurningMachine()) {
    for (const double left_m : {0.6, -0.6}) {
      RunningGear gear{.name = left_m > 0 ? "left_track" : "right_track", .drive_radius_m = 0.25};
      gear.patches.push_back({.p_B_m = {0, left_m, 0}});
      model.ground_tools.gears.push_back(gear);
    }
    const GnssModel receiver = {.white_horizontal_m = 0.008, .white_vertical_m = 0.012};
    input.machine = "m";
    input.sensors = {
        Described("left", how.link, MakePose({-0.9, 0.5, 1.4}), 10, receiver),
        Described("right", how.link, MakePose({-0.9, -0.5, 1.4}), 10, receiver),
        Described("encoders", "", Pose::Identity(), 50,
                  EncoderModel{.joints = {"swing", "boom", "left_track", "right_track"}})};
    measured.encoders = {NamedEncoders{.channel = "m/encoders"}};
    measured.encoders[0].recording.axes = {{"swing"}, {"boom"}, {"left_track"}, {"right_track"}};
    measured.imus.resize(3), measured.gnss.resize(3);
    Record(how);
    if (!how.has_right) measured.gnss[kRight].clear();
  }
  const DiagnosisInput& Input() {
    input.model = &model;
    return input;
  }

  MachineModel model;
  DiagnosisInput input;
  Measurements measured;

 private:
  void Record(const Tracked& how) {
    const Stream levers(7, "levers"), noise(7, "noise");
    constexpr double kStep_s = 0.02;
    double x = 3, y = -2, yaw = 0.4, swing = 0.1, left = 0, right = 0;
    for (int k = 0; k * kStep_s <= how.duration_s; ++k) {
      const double t_s = k * kStep_s;
      const auto level = [&](std::uint32_t which, double period_s) {
        const double at = levers.Uniform(static_cast<std::uint64_t>(t_s / period_s), which);
        return at < 0.4 ? 0.0 : 2 * at - 1;
      };
      AddEncoders(t_s, {swing, 0, left, right});
      if (k % 5 == 0) {
        const Pose X_WB = MakePose({x, y, 0}, 0, 0, yaw);
        AddFix(kLeft, X_WB, swing, t_s, how.left_late_s, how.noise_m * noise.Gaussian3(k, 0));
        AddFix(kRight, X_WB, swing, t_s, how.right_late_s, how.noise_m * noise.Gaussian3(k, 1));
      }
      const double left_mps = how.drives * level(0, 3.7), right_mps = how.drives * level(1, 4.3);
      const double forward_mps = (1 - how.slip) * (left_mps + right_mps) / 2;
      left += kStep_s * left_mps / 0.25, right += kStep_s * right_mps / 0.25;
      x += kStep_s * forward_mps * std::cos(yaw), y += kStep_s * forward_mps * std::sin(yaw);
      // Scrubbing tracks turn a machine by less than their distance implies.
      yaw += kStep_s * (right_mps - left_mps) / (1.3 * 1.2);
      swing += kStep_s * how.slews * 0.8 * level(2, 5.1);
    }
  }
  void AddEncoders(double t_s, const std::vector<double>& q_rad) {
    EncoderSample sample;
    sample.t_ns = sample.t_available_ns = FromSeconds(t_s);
    sample.q_rad = q_rad;
    sample.qd_radps.assign(4, 0);
    measured.encoders[0].recording.samples.push_back(sample);
  }
  void AddFix(std::size_t s, const Pose& X_WB, double swing, double t_s, double late_s,
              const Vec3& noise_m) {
    const Pose X_WL = ForwardKinematics(
        model, X_WB, {swing, 0})[static_cast<std::size_t>(model.LinkIndex(input.sensors[s].link))];
    GnssSample sample;
    sample.t_ns = sample.t_available_ns = FromSeconds(t_s + late_s);
    sample.enu_m = X_WL * input.sensors[s].X_BS.translation() + noise_m;
    sample.fix = GnssFix::kRtkFixed;
    measured.gnss[s].push_back(sample);
  }
};

std::vector<OffsetReceiver> Offset(const Tracked& how) {
  TrackedRecording recorded(how);
  return OffsetReceiversOf(recorded.Input(), recorded.measured);
}

void ExpectLeft(const std::vector<OffsetReceiver>& offset, double late_s) {
  ASSERT_THAT(offset, SizeIs(1));
  EXPECT_EQ(offset[0].target, "left");
  EXPECT_NEAR(offset[0].shift_s, late_s, 0.05);
  EXPECT_LT(offset[0].sigma_s, 0.05);
  EXPECT_LT(offset[0].p, 0.01);
}

TEST(OffsetReceivers, AreThoseWhoseAntennasMoveAtAnotherTimeThanTheMachine) {
  for (const double late_s : {18.0, -7.3, 1.5}) {
    ExpectLeft(Offset({.left_late_s = late_s}), late_s);
    ExpectLeft(Offset({.left_late_s = late_s, .has_right = false}), late_s);
    ExpectLeft(Offset({.left_late_s = late_s, .link = "undercarriage"}), late_s);
  }
}

TEST(OffsetReceivers, MayBeAll) {
  const auto offset = Offset({.left_late_s = 18, .right_late_s = 18});
  ASSERT_THAT(offset, SizeIs(2));
  EXPECT_NEAR(offset[0].shift_s, 18, 0.05);
  EXPECT_NEAR(offset[1].shift_s, 18, 0.05);
}

TEST(OffsetReceivers, AreFoundOnAMachineThatOnlySlews) {
  ExpectLeft(Offset({.drives = 0, .left_late_s = -7.3}), -7.3);
}

TEST(OffsetReceivers, AreFoundWhereTracksSlip) {
  ExpectLeft(Offset({.slip = 0.2, .left_late_s = -7.3}), -7.3);
}

TEST(OffsetReceivers, AreNoneWhereClocksAreRight) {
  for (const double noise_m : {0.01, 2.0}) {
    for (const double slip : {0.0, 0.2}) {
      EXPECT_THAT(Offset({.slip = slip, .noise_m = noise_m}), IsEmpty());
      EXPECT_THAT(Offset({.drives = 0, .noise_m = noise_m}), IsEmpty());
      EXPECT_THAT(Offset({.noise_m = noise_m, .duration_s = 22}), IsEmpty());
    }
  }
}

// The antennas on the undercarriage stay where they are.
TEST(OffsetReceivers, AreNotToldAtAStandstill) {
  EXPECT_THAT(Offset({.drives = 0, .left_late_s = 18, .link = "undercarriage"}), IsEmpty());
  EXPECT_THAT(Offset({.drives = 0, .slews = 0, .left_late_s = 18, .noise_m = 2}), IsEmpty());
}

TEST(OffsetReceivers, NeedAnEncoderOfEachJointBeforeThemAndOfEachTrack) {
  for (const std::size_t missing : {0u, 2u}) {
    TrackedRecording recorded({.left_late_s = 18});
    recorded.measured.encoders[0].recording.axes[missing].name = "other";
    EXPECT_THAT(OffsetReceiversOf(recorded.Input(), recorded.measured), IsEmpty());
  }
}

/// The effect of a wrong clock.
Effect ClockOffset(double offset_s) {
  for (const Mechanism& mechanism : SensorMechanisms()) {
    if (mechanism.id == "clock_offset") return {&mechanism, {offset_s}};
  }
  return {};
}

TEST(OffsetReceivers, AreNoneWhereTheScenarioSaysSo) {
  TrackedRecording recorded({.left_late_s = 18});
  recorded.input.sensors[kLeft].effects = {ClockOffset(18)};
  EXPECT_THAT(OffsetReceiversOf(recorded.Input(), recorded.measured), IsEmpty());
}

TEST(OffsetReceivers, AreToldByTheWholeOffsetOfTheirClocks) {
  TrackedRecording recorded({.left_late_s = 18});
  recorded.input.sensors[kLeft].effects = {ClockOffset(5)};
  const auto offset = OffsetReceiversOf(recorded.Input(), recorded.measured);
  ExpectLeft(offset, 13);
  DiagnosedSensors told;
  AddOffsetReceivers(offset, "m", &told);
  ASSERT_THAT(told.findings, SizeIs(1));
  const Finding& finding = told.findings[0].finding;
  EXPECT_EQ(finding.term.candidate->mechanism->id, "clock_offset");
  EXPECT_EQ(finding.term.candidate->target, "left");
  EXPECT_NEAR(finding.parameters[0].value, 18, 0.05);
  EXPECT_EQ(*finding.parameters[0].sigma, offset[0].sigma_s);
  EXPECT_EQ(finding.evidence.p, offset[0].p);
  EXPECT_TRUE(finding.is_confirmed);
}

TEST(OffsetReceivers, ThatStampAnewLeaveNothingWrong) {
  MadeRecording made(Made{.duration_s = 60});
  for (GnssSample& sample : made.measured.gnss[2]) sample.t_ns += FromSeconds(18);
  const auto offset = OffsetReceiversOf(made.Input(), made.measured);
  ExpectLeft(offset, 18);
  StampAnew(offset, &made.measured);
  EXPECT_NEAR(ToSeconds(made.measured.gnss[2].front().t_ns), 0, 0.03);
  StageClock clock;
  DiagnosedSensors told =
      DiagnosedOf(DiagnoseSensors(made.Input(), made.measured, {}, &clock), "m");
  EXPECT_THAT(told.findings, IsEmpty());
  AddOffsetReceivers(offset, "m", &told);
  ASSERT_THAT(told.findings, SizeIs(1));
  EXPECT_NEAR(told.findings[0].finding.parameters[0].value, 18, 0.03);
}

}  // namespace
}  // namespace tera
