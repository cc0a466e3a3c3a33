#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/recorded_drive.h"
#include "dataset/format/recording.h"

// Recordings of real machines that are too large to ship, in folders of TERA_RECORDINGS, which
// CMake receives: drive_warthog (the whole DRIVE recordings), emps, hydraulic_actuator.
// docs/evidence/real.md has the results.

namespace tera {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class RealRecording : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(folder_)) {
      GTEST_SKIP() << "no recordings in " << folder_ << "; configure with -DTERA_RECORDINGS=FOLDER";
    }
  }

  void Import(const std::string& name, const std::string& out) {
    const Outcome outcome = RunTera({"import", TERA_SOURCE_DIR "/config/import/drive_warthog.yaml",
                                     "--set", "file=" + (folder_ / name).string(), "--out", out},
                                    {scratch_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  const fs::path folder_ = fs::path(TERA_RECORDINGS) / "drive_warthog";
  const ScratchDirectory scratch_;
};

// RTKLIB's own solution of a receiver that was carried for 75 minutes (gnss_rtk), in GPS time: its
// first line has 21:28:42, 18 s ahead of UTC.
TEST(RealReceiver, ASolutionOfRtklibComesInBySuggestion) {
  const fs::path log = fs::path(TERA_RECORDINGS) / "gnss_rtk/demo5_b34f_f.pos";
  if (!fs::is_regular_file(log)) GTEST_SKIP() << "no " << log;
  const ScratchDirectory scratch;
  const Outcome suggested = RunTera({"import", "--suggest", log.string()}, {scratch.path()});
  ASSERT_EQ(suggested.status, 0) << suggested.err;
  WriteWholeFile(scratch.path() / "mapping.yaml", suggested.out);
  const Outcome in = RunTera({"import", "mapping.yaml", "--out", "in"}, {scratch.path()});
  ASSERT_EQ(in.status, 0) << in.err;
  EXPECT_THAT(in.out, HasSubstr("times count from 1608845304.000000000 s"));  // 21:28:24 UTC
  const auto fixes = Recording(scratch.path() / "in").LoadGnss("machine/gnss");
  ASSERT_EQ(fixes.size(), 4521u);
  EXPECT_EQ(fixes.front().fix, GnssFix::kRtkFloat);
  EXPECT_EQ(fixes.back().fix, GnssFix::kRtkFixed);
  EXPECT_EQ(fixes.back().t_ns, 4520 * kNsPerSecond);
  EXPECT_NEAR(fixes.back().lat_deg, 40.096655547, 1e-12);
  EXPECT_NEAR(fixes.back().alt_m, 1580.4040, 1e-9);
  EXPECT_NEAR(fixes.back().variance_enu_m2.x(), 0.0047 * 0.0047, 1e-12);
}

TEST_F(RealRecording, AParkedVehicleFeelsGravityAndDoesNotTurn) {
  Import("parked.csv", "parked");
  const Recording parked(scratch_.path() / "parked");
  EXPECT_FALSE(parked.info().simulated);
  const auto samples = parked.LoadImu("warthog/imu");
  ASSERT_GT(samples.size(), 10000u);
  Vec3 rate_radps = Vec3::Zero(), force_mps2 = Vec3::Zero();
  for (const ImuSample& s : samples) {
    rate_radps += s.w_WS_S_radps / static_cast<double>(samples.size());
    force_mps2 += s.f_S_mps2 / static_cast<double>(samples.size());
  }
  // A MEMS unit's biases: 0.1 m/s^2 is 10 mg, 0.005 rad/s is 0.3 deg/s.
  EXPECT_NEAR(force_mps2.norm(), 9.807, 0.1);
  EXPECT_LT(rate_radps.norm(), 0.005);
  // There is no pose; the channels are still compared.
  const Outcome compared =
      RunTera({"compare", "parked", "parked", "--plot", "none.png"}, {scratch_.path()});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("imu az_mps2"));
  EXPECT_THAT(compared.out, HasSubstr("no plot: no machine has poses"));
  EXPECT_FALSE(fs::exists(scratch_.path() / "none.png"));
}

TEST_F(RealRecording, TheWholeGrassDriveIsImportedWithItsPath) {
  Import("grass_2024-08-08.csv", "grass");
  const Recording grass(scratch_.path() / "grass");
  const auto poses = grass.LoadPose("truth/warthog/pose.csv").poses;
  ASSERT_GT(poses.size(), 1000u);
  double fastest_mps = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Vec3 moved_m = poses[i].X_WB.translation() - poses[i - 1].X_WB.translation();
    fastest_mps =
        std::max(fastest_mps, moved_m.norm() / ToSeconds(poses[i].t_ns - poses[i - 1].t_ns));
  }
  EXPECT_GT(fastest_mps, 1.0);
  EXPECT_LT(fastest_mps, 10.0) << "the vehicle's top speed is 5 m/s; a step of the pose is a fault";
}

TEST_F(RealRecording, DrivingAheadOnGrassIsSimulatedOverTheSameWay) {
  // 1.55 m/s ahead and -0.4 rad/s, from rest.
  CutDrive(folder_ / "grass_2024-08-08.csv", 269, 277.5, scratch_.path() / "ahead.csv");
  ImportAndReplay(scratch_.path() / "ahead.csv", 8.5, scratch_.path());
  const Outcome compared = RunTera({"compare", "real", "simulated"}, {scratch_.path()});
  EXPECT_EQ(compared.status, 0) << compared.err;
  const Comparison c = Compare(scratch_.path() / "real", scratch_.path() / "simulated");
  const TrajectoryError& e = c.machines.at(0).tracks.at(0).aligned_se2;
  EXPECT_GT(e.path_length_a_m, 8.0);
  EXPECT_NEAR(e.path_length_b_m, e.path_length_a_m, 0.2 * e.path_length_a_m);
  EXPECT_LT(e.ape_translation_m.rmse, 0.2 * e.path_length_a_m);
  EXPECT_LT(std::abs(DifferenceOf(c, "wz_radps").mean), 0.4) << "turns the same way";
}

using Json = nlohmann::json;

class DiagnosisOfReality : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(folder_ / "emps")) {
      GTEST_SKIP() << "no recordings in " << folder_ << "; configure with -DTERA_RECORDINGS=FOLDER";
    }
  }

  void Import(const std::string& mapping, const std::string& file, const std::string& out) {
    const Outcome outcome = RunTera({"import", TERA_SOURCE_DIR "/config/import/" + mapping, "--set",
                                     "file=" + (folder_ / file).string(), "--out", out},
                                    {scratch_.path()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  /// diagnosis.json of a recording against a scenario of config/scenarios.
  Json Diagnose(const std::string& scenario, const std::string& recording, const std::string& out,
                const Arguments& more = {}) {
    Arguments arguments = {"diagnose", TERA_SOURCE_DIR "/config/scenarios/" + scenario, recording,
                           "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = RunTera(arguments, {scratch_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::ifstream file(scratch_.path() / out / "diagnosis.json");
    return Json::parse(file, nullptr, false);
  }

  static double Number(const Json& json, const std::string& mechanism,
                       const std::string& parameter) {
    for (const Json& finding : json["findings"]) {
      if (finding["mechanism"] == mechanism) return finding["parameters"][parameter]["value"];
    }
    ADD_FAILURE() << "no finding of " << mechanism;
    return 0;
  }

  const fs::path folder_ = TERA_RECORDINGS;
  const ScratchDirectory scratch_;
};

TEST_F(DiagnosisOfReality, NamesTheFrictionOfThePositioningSystemAndForetellsForcesItHasNotSeen) {
  Import("emps.yaml", "emps/train.csv", "train");
  const Json why = Diagnose("emps.yaml", "train", "why");
  // Published with separate friction for each direction: Coulomb 20.4 N, viscous 167 and 240 N s/m.
  EXPECT_EQ(why["findings"].size(), 3u);
  EXPECT_NEAR(Number(why, "coulomb_friction", "effort_nm"), 20.4, 1.5);
  const double forward_nspm = Number(why, "viscous_friction", "coefficient_nmsprad");
  EXPECT_NEAR(forward_nspm, 167, 10);
  EXPECT_NEAR(forward_nspm + Number(why, "asymmetric_friction", "negative_nmsprad"), 240, 12);

  Import("emps.yaml", "emps/test_pulses.csv", "pulses");
  const Json after = Diagnose("emps.yaml", "pulses", "after", {"--effects", "why/effects.yaml"});
  EXPECT_EQ(after["findings"].size(), 0u);
  const Json& force = after["channels"][0];
  // 3.5 %; the aim is 4 %.
  EXPECT_LT(force["rmse"].get<double>(), 0.04 * force["rms"].get<double>());
}

TEST_F(DiagnosisOfReality, GivesTheHydraulicActuatorNoNameItDoesNotHave) {
  Import("hydraulic_actuator.yaml", "hydraulic_actuator/actuator.csv", "actuator");
  const Json why = Diagnose("hydraulic_actuator.yaml", "actuator", "why");
  EXPECT_EQ(why["verdict"][0], "unexplained");
  ASSERT_EQ(why["findings"].size(), 1u);
  EXPECT_EQ(why["findings"][0]["mechanism"], "unexplained");
  EXPECT_EQ(why["findings"][0]["regime"]["variable"], "lever/pressure");
}

// The slope of the ground under it is unknown, and is no bias of its forces.
TEST_F(DiagnosisOfReality, FindsNothingInAUnitOnAParkedVehicle) {
  Import("drive_warthog.yaml", "drive_warthog/parked.csv", "parked");
  const Json why = Diagnose(
      "warthog_asphalt.yaml", "parked", "why",
      {"--set", "machines[0].operator.csv=" + (folder_ / "drive_warthog/parked.csv").string()});
  EXPECT_EQ(why["verdict"][0], "none");
  EXPECT_TRUE(why["findings"].empty());
}

}  // namespace
}  // namespace tera
