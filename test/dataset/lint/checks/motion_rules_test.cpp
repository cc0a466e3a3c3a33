#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "dataset/lint/healthy_recording.h"

// Poses, levers, encoders, inertial units and receivers: commonly mistaken units and frames.

namespace tera {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::vector<std::string> kRates = {"wx_radps", "wy_radps", "wz_radps"};
const std::vector<std::string> kForces = {"ax_mps2", "ay_mps2", "az_mps2"};

class MotionRules : public LintTest {
 protected:
  static void Turn(std::vector<std::string>* fields, std::size_t i, std::size_t j) {
    std::swap((*fields)[i], (*fields)[j]);
  }
  /// Makes the boom turn steadily by 2.5 rad/s and wrap after a turn, as a slew does; keeps one row
  /// of 25 if `slow`.
  void LetTheBoomBeginAnew(bool slow) const {
    EditRows("digger/joints/data.csv", [&](int line, std::vector<std::string>* fields) {
      if (slow && line % 25 != 2) {
        fields->clear();
        return;
      }
      const double angle_rad = std::fmod(5 + 2.5 * 0.02 * (line - 2), 2 * kPi);
      (*fields)[1] = std::to_string(angle_rad);
    });
  }
  /// Leaves the unit without poses for comparison, in a real recording.
  void LeaveTheUnitAlone(const std::string& mount) const {
    fs::remove(run() / "truth/digger/pose.csv");
    Edit("dataset.yaml", "  - {path: \"truth/digger/pose.csv\", type: pose}\n", "");
    Edit("dataset.yaml", "simulated: true", "simulated: false");
    Put("digger/imu/sensor.yaml", "type: imu\nrate_hz: 100\n" + mount);
  }
};

TEST_F(MotionRules, AQuaternionThatIsNone) {
  EditRows("truth/digger/pose.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 5) (*fields)[4] = "0.5";
  });
  EXPECT_EQ(Only("poses.quaternion", "truth/digger/pose.csv").places[0].line, 5);
}

TEST_F(MotionRules, AQuaternionOfTheOtherSign) {
  Scale("truth/digger/pose.csv", {"qw", "qx", "qy", "qz"}, -1);
  EXPECT_THAT(Only("poses.quaternion", "truth/digger/pose.csv").places[0].message,
              HasSubstr("qw is -"));
}

TEST_F(MotionRules, VelocitiesInKilometresAnHour) {
  Scale("truth/digger/pose.csv", {"vx_mps", "vy_mps", "vz_mps"}, 3.6);
  EXPECT_THAT(Only("poses.velocity", "truth/digger/pose.csv").places[0].message,
              HasSubstr("by positions"));
}

TEST_F(MotionRules, RatesOfPosesInDegrees) {
  Scale("truth/digger/pose.csv", kRates, 1 / kDeg);
  Only("poses.velocity", "truth/digger/pose.csv");
}

TEST_F(MotionRules, AMachineThatFallsFreely) {
  // From 0.5 s on; velocities fall with it.
  EditRows("truth/digger/pose.csv", [](int, std::vector<std::string>* fields) {
    const double fallen_s = std::max(0.0, std::stod((*fields)[0]) / 1e9 - 0.5);
    (*fields)[3] = fmt::format("{}", 0.3 - 0.5 * 9.81 * fallen_s * fallen_s);
    (*fields)[10] = fmt::format("{}", -9.81 * fallen_s);
  });
  const LintReport report = Linted();
  const auto found =
      std::find_if(report.findings.begin(), report.findings.end(),
                   [](const LintFinding& finding) { return finding.rule->id == "poses.ground"; });
  ASSERT_NE(found, report.findings.end());
  EXPECT_EQ(found->channel, "truth/digger/pose.csv");
  EXPECT_THAT(found->places.at(0).message, HasSubstr("falls freely for 0.8 s from this row"));
  // Rows are 0.02 s apart, the first on line 2; the tolerance takes in some before the fall.
  EXPECT_NEAR(found->places.at(0).line, 2 + 25, 10);
}

TEST_F(MotionRules, AHopIsNoFall) {
  // 0.6 s in the air: 1.77 m at a time.
  EditRows("truth/digger/pose.csv", [](int, std::vector<std::string>* fields) {
    const double t_s = std::fmod(std::stod((*fields)[0]) / 1e9, 0.6) - 0.3;
    (*fields)[3] = fmt::format("{}", 0.3 + 0.5 * 9.81 * (0.09 - t_s * t_s));
    (*fields)[10] = fmt::format("{}", -9.81 * t_s);
  });
  EXPECT_THAT(Found(), testing::Not(testing::Contains("poses.ground")));
}

TEST_F(MotionRules, AMachineMetresBelowAllGround) {
  const auto found_above = [&](double lowest_m) {
    std::set<std::string> ids;
    const LintReport report = Linted({.lowest_m = [&](const fs::path& raster) {
      EXPECT_EQ(raster.filename(), "height_start.tif");
      return lowest_m;
    }});
    for (const LintFinding& finding : report.findings) ids.emplace(finding.rule->id);
    return ids;
  };
  EXPECT_EQ(found_above(0.3 + 4.9), std::set<std::string>{});
  EXPECT_EQ(found_above(0.3 + 5.1), std::set<std::string>{"poses.ground"});
}

TEST_F(MotionRules, LeversInPercent) {
  Scale("digger/commands.csv", {"stick"}, 100);
  EXPECT_EQ(Only("commands.range", "digger/commands.csv").places[0].message, "stick is -100");
}

TEST_F(MotionRules, EncoderRatesInDegrees) {
  Scale("digger/joints/data.csv", {"boom_radps"}, 1 / kDeg);
  EXPECT_THAT(Only("encoders.rates", "digger/joints").places[0].message,
              HasSubstr("as if they were degrees"));
}

TEST_F(MotionRules, TravelInMillimetresPerSecond) {
  Scale("digger/joints/data.csv", {"stick_mps"}, 1000);
  EXPECT_THAT(Only("encoders.rates", "digger/joints").places[0].message, HasSubstr("stick_m"));
}

TEST_F(MotionRules, AnEncoderThatCountsBackwards) {
  Scale("digger/joints/data.csv", {"boom_radps"}, -1);
  Only("encoders.rates", "digger/joints");
}

// Both in degrees agree with each other; without truth only their magnitude reveals it.
TEST_F(MotionRules, AnEncoderAllInDegrees) {
  fs::remove(run() / "truth/digger/joints.csv");
  Edit("dataset.yaml", "  - {path: \"truth/digger/joints.csv\", type: table}\n", "");
  Scale("digger/joints/data.csv", {"boom_rad", "boom_radps"}, 1 / kDeg);
  EXPECT_TRUE(Found().empty()) << "14 rad/s are possible";
  Scale("digger/joints/data.csv", {"boom_rad", "boom_radps"}, 10);
  EXPECT_THAT(Only("encoders.radians", "digger/joints").places[0].message,
              HasSubstr("rad at the first row"));
}

// A boom at 15 deg that rises to 25 deg and sinks again, and one that stays at 20 deg. A wheel and
// a swinging cab may be at these angles.
TEST_F(MotionRules, AnAngleOfSomeTurnsIsInDegreesWhereItsJointNeitherTurnsOnNorSwings) {
  fs::remove(run() / "truth/digger/joints.csv");
  Edit("dataset.yaml", "  - {path: \"truth/digger/joints.csv\", type: table}\n", "");
  const auto boom = [&](double start, double amplitude, double speed) {
    EditRows("digger/joints/data.csv", [&](int, std::vector<std::string>* fields) {
      const double t_s = std::stod((*fields)[0]) / 1e9;
      (*fields)[1] = fmt::format("{}", start + speed * t_s + amplitude * std::sin(kPi * t_s));
      (*fields)[3] = fmt::format("{}", speed + amplitude * kPi * std::cos(kPi * t_s));
    });
  };
  boom(15, 10, 0);
  EXPECT_EQ(Only("encoders.radians", "digger/joints").places[0].line, 2);
  boom(20, 0, 0);
  Only("encoders.radians", "digger/joints");
  boom(20, 0, 9);  // a wheel
  EXPECT_THAT(Found(), testing::IsEmpty());
  boom(20, 0.4, 0);  // a cab
  EXPECT_THAT(Found(), testing::IsEmpty());
  boom(3, 0.4, 0);
  EXPECT_THAT(Found(), testing::IsEmpty());
}

// 2.5 rad/s for 2 s from 5 rad on pass 2 pi once, at 0.51 s: from row 25 to 26 after the header,
// and at 2 Hz from the row of 0.5 s to that of 1 s.
TEST_F(MotionRules, AnAngleThatBeginsAnewIsAJumpAtAnyRateAndNotDegrees) {
  fs::remove(run() / "truth/digger/joints.csv");
  Edit("dataset.yaml", "  - {path: \"truth/digger/joints.csv\", type: table}\n", "");
  LetTheBoomBeginAnew(false);
  // The rates are differences over two rows: at the jump (0.1 - 2 pi) / 0.04 s, beyond 100 rad/s.
  EditRows("digger/joints/data.csv", [](int line, std::vector<std::string>* fields) {
    (*fields)[3] = line == 27 || line == 28 ? "-154.6" : "2.5";
  });
  const LintFinding fast = Only("encoders.jump", "digger/joints");
  EXPECT_EQ(fast.count, 1);
  EXPECT_EQ(fast.places[0].line, 28);
  EXPECT_THAT(fast.places[0].message, HasSubstr("boom_rad goes from 6.25 to 0.0168"));
  Put("digger/joints/sensor.yaml", "type: encoder\nrate_hz: 2\n");
  LetTheBoomBeginAnew(true);
  EXPECT_EQ(Only("encoders.jump", "digger/joints").places[0].line, 4);
}

TEST_F(MotionRules, AnEncoderWithAnotherZero) {
  EditRows("digger/joints/data.csv", [](int, std::vector<std::string>* fields) {
    (*fields)[1] = std::to_string(std::stod((*fields)[1]) + 0.3);
  });
  EXPECT_THAT(Only("encoders.truth", "digger/joints").places[0].message,
              HasSubstr("boom_rad is 0.3 rad"));
}

TEST_F(MotionRules, GyroscopeInDegrees) {
  Scale("digger/imu/data.csv", kRates, 1 / kDeg);
  EXPECT_THAT(Only("imu.rates", "digger/imu").places[0].message,
              HasSubstr("as if they were degrees"));
}

TEST_F(MotionRules, GyroscopeWithAnotherSign) {
  Scale("digger/imu/data.csv", kRates, -1);
  Only("imu.rates", "digger/imu");
}

TEST_F(MotionRules, GyroscopeInDegreesOfAUnitWhoseMountIsNotKnown) {
  Put("digger/imu/sensor.yaml", "type: imu\nrate_hz: 100\n");
  EXPECT_TRUE(Found().empty());
  Scale("digger/imu/data.csv", kRates, 1 / kDeg);
  EXPECT_THAT(Only("imu.rates", "digger/imu").places[0].message,
              HasSubstr("57.3 times as far as its machine"));
}

// The healthy unit is pitched by 0.1 rad: its z is 9.755 m/s2. The report has the opposite.
TEST_F(MotionRules, AUnitWhoseZPointsDown) {
  LeaveTheUnitAlone("");
  EXPECT_TRUE(Found().empty());
  // Forward, right, down instead of forward, left, up: half a turn about x.
  Scale("digger/imu/data.csv", {"wy_radps", "wz_radps", "ay_mps2", "az_mps2"}, -1);
  EXPECT_THAT(
      Only("imu.down", "digger/imu").places[0].message,
      HasSubstr("at rest az is -9.75 m/s2, about -g: does its z point down? give it rpy_deg: "
                "[180, 0, 0]"));
}

TEST_F(MotionRules, AUnitThatHangsUpsideDownByItsMountIsFine) {
  LeaveTheUnitAlone(
      "parent_link: chassis\nX_parent_sensor: {xyz_m: [0, 0, 1], quaternion_wxyz: [0, "
      "1, 0, 0]}\n");
  EXPECT_THAT(Only("imu.down", "digger/imu").places[0].message,
              HasSubstr("deg from the downward direction of its mount"));
  Scale("digger/imu/data.csv", {"wy_radps", "wz_radps", "ay_mps2", "az_mps2"}, -1);
  EXPECT_TRUE(Found().empty());
}

TEST_F(MotionRules, AUnitWithoutGravity) {
  LeaveTheUnitAlone("");
  Scale("digger/imu/data.csv", kForces, 0.001);
  EXPECT_THAT(Only("imu.gravity", "digger/imu").places[0].message,
              HasSubstr("was gravity subtracted?"));
}

TEST_F(MotionRules, RatesInDegreesOfAUnitWithoutPoses) {
  LeaveTheUnitAlone("");
  Scale("digger/imu/data.csv", kRates, 1 / kDeg);
  EXPECT_THAT(Only("imu.units", "digger/imu").places[0].message, HasSubstr("unit: deg/s"));
}

TEST_F(MotionRules, APlaceOnAMapThatIsFarFromTheOrigin) {
  EditRows("truth/digger/pose.csv", [](int, std::vector<std::string>* fields) {
    (*fields)[1] = std::to_string(std::stod((*fields)[1]) + 600'000);
  });
  EXPECT_THAT(Found(), testing::Contains("places.far"));
}

TEST_F(MotionRules, AReceiverFarFromTheOrigin) {
  Edit("dataset.yaml", "lat_deg: 46.78", "lat_deg: 45.78");  // 111 km
  EditRows("digger/gnss/data.csv", [](int, std::vector<std::string>* fields) {
    (*fields)[5] = std::to_string(std::stod((*fields)[5]) + 111'000);
  });
  EXPECT_THAT(Found(), testing::Contains("places.far"));
}

TEST_F(MotionRules, ForceInG) {
  Put("digger/imu/sensor.yaml", "type: imu\nrate_hz: 100\n");  // otherwise imu.up reports too
  Scale("digger/imu/data.csv", kForces, 1 / 9.80665);
  EXPECT_THAT(Only("imu.gravity", "digger/imu").places[0].message, HasSubstr("is 1 m/s2"));
}

TEST_F(MotionRules, ForceWithGravityDownwards) {
  Scale("digger/imu/data.csv", kForces, -1);
  EXPECT_THAT(Only("imu.up", "digger/imu").places[0].message, HasSubstr("-9.8"));
}

// Recorded poses of the sensor itself are the reference.
TEST_F(MotionRules, AMountThatIsNotTheRecordedOne) {
  fs::create_directories(run() / "truth/digger/sensors");
  fs::copy(run() / "truth/digger/pose.csv", run() / "truth/digger/sensors/imu.csv");
  EditRows("truth/digger/sensors/imu.csv", [](int, std::vector<std::string>* fields) {
    (*fields)[4] = (*fields)[6] = (*fields)[7] = "0";  // half a turn about x: upside down
    (*fields)[5] = "1";
  });
  Edit("dataset.yaml", "channels:\n",
       "channels:\n  - {path: \"truth/digger/sensors/imu.csv\", type: pose}\n");
  EXPECT_THAT(Found(), testing::Contains("imu.up"));
}

TEST_F(MotionRules, AFixThatIsNone) {
  EditRows("digger/gnss/data.csv", [](int line, std::vector<std::string>* fields) {
    if (line == 3) (*fields)[7] = "6";
    if (line == 4) (*fields)[8] = "-1";
  });
  const LintFinding finding = Only("gnss.values", "digger/gnss");
  ASSERT_EQ(finding.count, 2);
  EXPECT_THAT(finding.places[0].message, HasSubstr("fix is 6"));
}

TEST_F(MotionRules, ARowWithoutFixMeansNothing) {
  EditRows("digger/gnss/data.csv", [](int line, std::vector<std::string>* fields) {
    if (line % 2 == 0) std::fill(fields->begin() + 1, fields->end(), "0");
  });
  EXPECT_TRUE(Found().empty());
}

TEST_F(MotionRules, AHeightAboveTheGeoid) {
  EditRows("digger/gnss/data.csv", [](int, std::vector<std::string>* fields) {
    (*fields)[3] = std::to_string(std::stod((*fields)[3]) + 28);
  });
  EXPECT_THAT(Only("gnss.geodesy", "digger/gnss").places[0].message, HasSubstr("28 m"));
}

TEST_F(MotionRules, LatitudeAndLongitudeTheOtherWayRound) {
  EditRows("digger/gnss/data.csv",
           [](int, std::vector<std::string>* fields) { Turn(fields, 1, 2); });
  Only("gnss.geodesy", "digger/gnss");
}

TEST_F(MotionRules, AReceiverFarFromItsMachine) {
  EditRows("truth/digger/pose.csv", [](int, std::vector<std::string>* fields) {
    (*fields)[1] = std::to_string(std::stod((*fields)[1]) + 500);
  });
  Only("gnss.pose", "digger/gnss");
}

}  // namespace
}  // namespace tera
