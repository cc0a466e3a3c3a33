#include "app/recorded_drive.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/motion.h"
#include "core/units.h"
#include "dataset/format/recording.h"

// The shipped recording against its simulation, by the commands in docs.

namespace tera {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

constexpr const char* kAsphalt =
    TERA_SOURCE_DIR "/examples/recordings/drive_warthog/asphalt_2024-09-20.csv";

// From config/machines/warthog.yaml, the vehicle's own.
constexpr double kGauge_m = 1.08, kWheelbase_m = 0.90, kRadius_m = 0.30;
/// Widening of the gauge b by which a skid-steer vehicle of wheelbase l turns on the spot, at rate
/// w. Friction opposes each wheel's slip: v - w b / 2 along the wheel, at b / 2 from the middle,
/// and w l / 2 across it, at l / 2. The torques balance at v = w b / 2 (1 + (l / b)^2).
constexpr double kWidening = 1 + (kWheelbase_m / kGauge_m) * (kWheelbase_m / kGauge_m);

/// A vehicle's motion from rest to rest, by three instruments of one recording.
struct Turn {
  double by_gyro_rad = 0;
  double by_pose_rad = 0;
  double by_wheels_rad = 0;  ///< if none slid
  double rolled_m = 0;       ///< by both sides in the mean
  double moved_m = 0;
};

/// Angle from the first pose to the last about the vertical, less whole turns.
double HeadingChange_rad(const Pose& first, const Pose& last) {
  const Mat3 R = first.linear().transpose() * last.linear();
  return std::atan2(R(1, 0), R(0, 0));
}

Turn TurnOf(const Recording& recording, const std::string& machine) {
  Turn turn;
  const auto imu = recording.LoadImu(machine + "/imu");
  for (std::size_t i = 1; i < imu.size(); ++i) {
    turn.by_gyro_rad += imu[i].w_WS_S_radps.z() * ToSeconds(imu[i].t_ns - imu[i - 1].t_ns);
  }
  const EncoderRecording wheels = recording.LoadEncoder(machine + "/wheels");
  EXPECT_THAT(wheels.axes.at(0).name, HasSubstr("left"));
  for (std::size_t i = 1; i < wheels.samples.size(); ++i) {
    const auto& rate_radps = wheels.samples[i].qd_radps;
    const double dt_s = ToSeconds(wheels.samples[i].t_ns - wheels.samples[i - 1].t_ns);
    turn.by_wheels_rad += (rate_radps[1] - rate_radps[0]) * kRadius_m / kGauge_m * dt_s;
    turn.rolled_m += 0.5 * (rate_radps[1] + rate_radps[0]) * kRadius_m * dt_s;
  }
  const auto poses = recording.LoadPose("truth/" + machine + "/pose.csv").poses;
  const Pose &first = poses.front().X_WB, &last = poses.back().X_WB;
  turn.by_pose_rad = HeadingChange_rad(first, last);
  turn.moved_m = (last.translation() - first.translation()).head<2>().norm();
  return turn;
}

TEST(RecordedDrive, ATurnOnTheSpotIsSimulatedAndRecordedAsFrictionHasIt) {
  const ScratchDirectory scratch;
  // A turn to the left, from rest to rest.
  CutDrive(kAsphalt, 334, 344, scratch.path() / "turn.csv");
  ImportAndReplay(scratch.path() / "turn.csv", 9.9, scratch.path());
  const Outcome compared = RunTera({"compare", "real", "simulated"}, {scratch.path()});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_THAT(compared.out,
              AllOf(HasSubstr("warthog and warthog1"), ContainsRegex("APE, SE.2. aligned +[0-9]"),
                    ContainsRegex("RPE over 1 s +[0-9]"), ContainsRegex("imu wz_radps +[0-9]"),
                    ContainsRegex("wheels left_track_radps +[0-9]")));

  const Outcome replay = RunTera({"replay", "real", "--out", "again"}, {scratch.path()});
  EXPECT_EQ(replay.status, 2);
  EXPECT_THAT(replay.err, HasSubstr("real: is a real recording; need a simulated one"));

  for (const auto& [recording, machine] :
       {std::pair("real", "warthog"), std::pair("simulated", "warthog1")}) {
    const Turn turn = TurnOf(Recording(scratch.path() / recording), machine);
    SCOPED_TRACE(fmt::format(
        "{}: gyro {:.3f} rad, pose {:.3f}, wheels {:.3f}; rolled {:.3f} m, moved {:.3f}", recording,
        turn.by_gyro_rad, turn.by_pose_rad, turn.by_wheels_rad, turn.rolled_m, turn.moved_m));
    // Ten seconds of a gyro with a bias of 5 mrad/s.
    EXPECT_NEAR(std::remainder(turn.by_gyro_rad - turn.by_pose_rad, 2 * kPi), 0, 0.05);
    EXPECT_NEAR(turn.by_wheels_rad / turn.by_gyro_rad, kWidening, 0.1 * kWidening);
    // On the spot: no further than its wheels rolled, except for the registration's few centimetres
    // and the arc.
    EXPECT_LT(turn.moved_m, std::abs(turn.rolled_m) + 0.1);
  }

  // The simulated wheels turn as commanded, 1.67 rad/s for 3.9 s. The vehicle's, whose rates still
  // grew when the command ended, came half as far.
  const double commanded_rad = 6.5;
  EXPECT_NEAR(TurnOf(Recording(scratch.path() / "simulated"), "warthog1").by_wheels_rad,
              commanded_rad, 0.02 * commanded_rad);
  EXPECT_NEAR(TurnOf(Recording(scratch.path() / "real"), "warthog").by_wheels_rad,
              0.52 * commanded_rad, 0.02 * commanded_rad);
}

}  // namespace
}  // namespace tera
