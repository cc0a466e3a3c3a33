#include "app/recorded_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dataset/format/recording.h"

// The shipped recording beside its simulation, by the commands that docs name.

namespace tera {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

constexpr const char* kAsphalt =
    TERA_SOURCE_DIR "/examples/recordings/drive_warthog/asphalt_2024-09-20.csv";

/// Integral of the yaw rate of an IMU.
double Turned_rad(const Recording& recording, const std::string& imu) {
  const auto samples = recording.LoadImu(imu);
  double angle_rad = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    angle_rad += samples[i].w_WS_S_radps.z() * ToSeconds(samples[i].t_ns - samples[i - 1].t_ns);
  }
  return angle_rad;
}

TEST(RecordedDrive, TurningOnTheSpotIsSimulatedTheSameWayRound) {
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

  // A skid-steer vehicle turns by less than its wheels would have it.
  const double commanded_rad = 6.5;  // 1.67 rad/s for 3.9 s
  for (const auto& [recording, imu] :
       {std::pair("real", "warthog/imu"), std::pair("simulated", "warthog1/imu")}) {
    const double turned_rad = Turned_rad(Recording(scratch.path() / recording), imu);
    EXPECT_GT(turned_rad, 0.2 * commanded_rad) << recording;
    EXPECT_LT(turned_rad, commanded_rad) << recording;
  }
}

}  // namespace
}  // namespace tera
