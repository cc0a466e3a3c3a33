#include "dataset/import/import_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/config/config.h"
#include "core/faults.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr double kTight = 1e-12;

/// A logger's file, its mapping, and the resulting recording.
class ImportTest : public testing::Test {
 protected:
  ImportTest() {
    WriteWholeFile(scratch_.path() / "log.csv",
                   "ms,state,gx,gy,gz,ax,ay,az,rpm,east_mm,yaw_w,yaw_z,lat,lon,n\n"
                   "1000,idle,90,0,0,0,0,1,60,0,0,0,46.78,-71.27,0\n"
                   "1100,idle,0,180,0,0.5,0,1,60,250,1,0,46.78,-71.27,1\n"
                   "1200,dig,0,0,-90,0,0,1,120,250,1,0,46.78,-71.27,1\n"
                   "1300,dig,0,0,0,0,0,1,120,1000,0.6,0.8,46.781,-71.27,2");
  }
  std::string Top() const {
    return "name: logged\nmachine: digger\nfile: log.csv\n"
           "time: {column: ms, unit: ms, offset: -1}\n"
           "origin: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90}\n";
  }
  Recording Import(const std::string& channels) const {
    WriteWholeFile(scratch_.path() / "mapping.yaml", Top() + channels);
    fs::remove_all(scratch_.path() / "out");
    ImportCsv(scratch_.path() / "mapping.yaml", scratch_.path() / "out");
    return Recording(scratch_.path() / "out");
  }

  ScratchDirectory scratch_;
};

constexpr char kImu[] =
    "imus:\n  - name: imu\n    rpy_deg: [0, 0, 90]\n    columns:\n"
    "      wx: {column: gx, unit: deg/s}\n      wy: {column: gy, unit: deg/s}\n"
    "      wz: {column: gz, unit: deg/s, scale: -1}\n      ax: {column: ax, unit: g}\n"
    "      ay: {column: ay, unit: g}\n      az: {column: az, unit: g, offset: 0.01}\n";

TEST_F(ImportTest, ALogInThePlaceOfItsMappingIsRefusedWithTheWayToOne) {
  WriteWholeFile(scratch_.path() / "book.xlsx", "PK\x03\x04[Content_Types].xml");
  WriteWholeFile(scratch_.path() / "can.log", "(1436509052.249713) vcan0 044#2A366C2BBA\n");
  WriteWholeFile(scratch_.path() / "log.txt", "t;x\n0;1\n");
  for (const std::string name : {"log.csv", "book.xlsx", "can.log", "log.txt"}) {
    EXPECT_THAT([&] { ImportCsv(scratch_.path() / name, scratch_.path() / "out"); },
                ThrowsFault(FaultKind::kUnsupported, name));
  }
  EXPECT_FALSE(fs::exists(scratch_.path() / "out"));
}

TEST_F(ImportTest, ConvertsUnitsScalesOffsetsAndAxesOfAnImu) {
  const Recording recording = Import(kImu);
  EXPECT_FALSE(recording.info().simulated);
  const auto imu = recording.LoadImu("digger/imu");
  ASSERT_EQ(imu.size(), 4u);
  EXPECT_EQ(imu[0].t_ns, 0);
  EXPECT_EQ(imu[1].t_ns, 100'000'000);
  // The logger's x is the sensor's y, its y the sensor's -x.
  EXPECT_TRUE(imu[0].w_WS_S_radps.isApprox(Vec3(0, kPi / 2, 0), kTight));
  EXPECT_TRUE(imu[1].w_WS_S_radps.isApprox(Vec3(-kPi, 0, 0), kTight));
  EXPECT_TRUE(imu[2].w_WS_S_radps.isApprox(Vec3(0, 0, kPi / 2), kTight));
  EXPECT_TRUE(imu[1].f_S_mps2.isApprox(Vec3(0, 4.903325, 9.81665), kTight));
}

TEST_F(ImportTest, IntegratesTheRateOfAnEncoderWithoutAngles) {
  const Recording recording = Import(
      "encoders:\n  - name: wheels\n    joints: [{name: left, rate: {column: rpm, unit: rpm}}]\n");
  const EncoderRecording wheels = recording.LoadEncoder("digger/wheels");
  // 2 pi rad/s for 0.1 s, then ramping to 4 pi over 0.1 s, then 4 pi for 0.1 s.
  EXPECT_NEAR(wheels.samples[0].qd_radps[0], 2 * kPi, kTight);
  EXPECT_NEAR(wheels.samples[1].q_rad[0], 0.2 * kPi, kTight);
  EXPECT_NEAR(wheels.samples[2].q_rad[0], 0.5 * kPi, kTight);
  EXPECT_NEAR(wheels.samples[3].q_rad[0], 0.9 * kPi, kTight);
}

TEST_F(ImportTest, TakesAnglesWhereThereAreSome) {
  const Recording recording = Import(
      "encoders:\n  - name: joints\n    joints:\n      - name: boom\n"
      "        angle: {column: gx, unit: deg}\n        rate: {column: gy, unit: deg/s}\n");
  const EncoderRecording joints = recording.LoadEncoder("digger/joints");
  EXPECT_NEAR(joints.samples[0].q_rad[0], kPi / 2, kTight);
  EXPECT_NEAR(joints.samples[1].qd_radps[0], kPi, kTight);
}

TEST_F(ImportTest, DifferentiatesAnAngleWithoutRates) {
  const Recording recording = Import(
      "encoders:\n  - name: e\n    joints: [{name: left, travel: {column: east_mm, unit: mm}}]\n");
  const EncoderRecording travel = recording.LoadEncoder("digger/e");
  // 0, 0.25, 0.25 and 1 m, 0.1 s apart.
  const double speed_mps[] = {2.5, 1.25, 3.75, 7.5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(travel.samples[i].qd_radps[0], speed_mps[i], 1e-9) << i;
  }
}

TEST_F(ImportTest, AnglesInDegreesThatAreTakenForRadiansAreToldByTheirRates) {
  // The boom turns from 30 to 36 degrees in 0.2 s, at 0.5 rad/s; read as radians, at 30.
  WriteWholeFile(scratch_.path() / "log.csv", "ms,boom,arm\n1000,30,1\n1100,33,1\n1200,36,1\n");
  for (const std::string unit : {"deg", "rad"}) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   Top() +
                       "encoders:\n  - name: joints\n    joints:\n      - {name: boom, angle: "
                       "{column: boom, unit: " +
                       unit + "}}\n      - {name: arm, angle: {column: arm, unit: rad}}\n");
    const ImportReport report =
        ImportCsv(scratch_.path() / "mapping.yaml", "", {.checks_only = true});
    ASSERT_EQ(report.channels.size(), 1u);
    EXPECT_EQ(report.channels[0].too_fast, unit == "rad" ? 3 : 0);
    EXPECT_NEAR(report.channels[0].fastest_radps, unit == "rad" ? 30 : 0, 1e-9);
    EXPECT_EQ(report.channels[0].fastest_joint, unit == "rad" ? "boom" : "");
  }
}

TEST_F(ImportTest, CountsTimeByRowsWhereThereIsNoColumnOfIt) {
  const Recording recording = Import(
      "tables:\n  - name: efforts\n    time: {interval: 50, unit: ms, offset: 2}\n"
      "    valid_if: [{column: n, above: 0}]\n"
      "    columns: {lift_n: {column: rpm, unit: kN}, turn_nm: {column: rpm, unit: N m}}\n");
  const TableRecording table = recording.LoadTable("digger/efforts.csv");
  // The first row does not count, but its time does.
  ASSERT_EQ(table.t_ns.size(), 3u);
  EXPECT_EQ(table.t_ns[0], 2'050'000'000);
  EXPECT_EQ(table.t_ns[2], 2'150'000'000);
  EXPECT_EQ(table.rows[0], (std::vector<double>{60000, 60}));
}

constexpr char kPose[] =
    "pose:\n  world: {xyz_m: [10, 0, 0], rpy_deg: [0, 0, 90]}\n  body: {xyz_m: [0, 0, -1]}\n"
    "  columns:\n    x: {column: east_mm, unit: mm}\n    y: {constant: 0}\n"
    "    z: {constant: 1.5}\n    qw: {column: yaw_w, unit: '1'}\n    qx: {constant: 0}\n"
    "    qy: {constant: 0}\n    qz: {column: yaw_z, unit: '1'}\n";

TEST_F(ImportTest, PlacesPosesInTheWorldAndSkipsRowsThatDoNotCount) {
  const Recording recording = Import(
      std::string(kPose) + "  valid_if: [{column: n, above: 0}, {column: n, changes: true}]\n");
  const PoseRecording pose = recording.LoadPose("truth/digger/pose.csv");
  EXPECT_FALSE(pose.has_velocity);
  ASSERT_EQ(pose.poses.size(), 2u);
  EXPECT_EQ(pose.poses[0].t_ns, 100'000'000);
  EXPECT_EQ(pose.poses[1].t_ns, 300'000'000);
  // 0.25 m east in the logger's world is 0.25 m along y of W; the body is 1 m below the tracker.
  EXPECT_TRUE(pose.poses[0].X_WB.translation().isApprox(Vec3(10, 0.25, 0.5), kTight));
  const double yaw_rad = RpyFromRotation(pose.poses[1].X_WB.linear()).z();
  EXPECT_NEAR(yaw_rad, kPi / 2 + 2 * std::atan2(0.8, 0.6) - 2 * kPi, kTight);
}

TEST_F(ImportTest, SelectsRowsByEachRule) {
  const auto rows = [&](const std::string& rule) {
    return Import("tables: [{name: t, columns: {e: {column: east_mm, unit: mm}}, valid_if: [" +
                  rule + "]}]\n")
        .LoadTable("digger/t.csv")
        .rows.size();
  };
  EXPECT_EQ(rows("{column: n, above: 1}"), 1u);
  EXPECT_EQ(rows("{column: n, below: 1}"), 1u);
  EXPECT_EQ(rows("{column: n, equals: 1}"), 2u);
  EXPECT_EQ(rows("{column: state, changes: true}"), 2u);
}

TEST_F(ImportTest, PutsGnssIntoTheTangentPlaneOfTheOrigin) {
  const Recording recording = Import(
      "gnss:\n  - name: gnss\n    columns:\n      lat: {column: lat, unit: deg}\n"
      "      lon: {column: lon, unit: deg}\n      alt: {constant: 92.5}\n      fix: {constant: 4}\n"
      "      var_e: {constant: 0.0004}\n      var_n: {constant: 0.0004}\n"
      "      var_u: {constant: 0.0016}\n");
  const auto gnss = recording.LoadGnss("digger/gnss");
  EXPECT_NEAR(gnss[0].enu_m.norm(), 2.5, 1e-8);
  EXPECT_EQ(gnss[0].fix, GnssFix::kRtkFixed);
  EXPECT_NEAR(gnss[0].lat_deg, 46.78, kTight);
  // 0.001 deg of latitude at 46.78 deg: meridian radius 6369.4 km, so 111.167 m.
  EXPECT_NEAR(gnss[3].enu_m.y(), 111.167, 0.01);
  EXPECT_EQ(gnss[0].variance_enu_m2.z(), 0.0016);
}

/// A receiver's columns, with `edit` in place of the same text.
std::string Gnss(const std::string& from = "", const std::string& to = "") {
  std::string text =
      "gnss:\n  - name: gnss\n    columns:\n      lat: {column: lat, unit: deg}\n"
      "      lon: {column: lon, unit: deg}\n      alt: {constant: 92.5}\n      fix: {constant: 4}\n"
      "      var_e: {constant: 0.0004}\n      var_n: {constant: 0.0004}\n"
      "      var_u: {constant: 0.0016}\n";
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return text;
}

TEST_F(ImportTest, TakesTheFixesOfGga) {
  // The column n is 0, 1, 1, 2.
  const Recording recording = Import(Gnss("{constant: 4}", "{column: n, unit: '1'}"));
  const auto gnss = recording.LoadGnss("digger/gnss");
  EXPECT_EQ(gnss[0].fix, GnssFix::kNone);
  EXPECT_EQ(gnss[1].fix, GnssFix::kSingle);
  EXPECT_EQ(gnss[3].fix, GnssFix::kDifferential);
  EXPECT_EQ(gnss[0].lat_deg, 0);  // without a fix there is no position
  EXPECT_NEAR(gnss[3].lat_deg, 46.781, kTight);
}

TEST_F(ImportTest, RejectsAFixThatIsNone) {
  for (const char* scale : {"3", "0.5"}) {
    EXPECT_THAT(
        [&] {
          Import(
              Gnss("{constant: 4}", "{column: n, unit: '1', scale: " + std::string(scale) + "}"));
        },
        ThrowsFault(FaultKind::kOutOfRange, "log.csv:3"));
  }
  EXPECT_THAT([&] { Import(Gnss("{constant: 4}", "{constant: 3}")); },
              ThrowsFault(FaultKind::kInconsistent, "columns.fix.constant"));
}

TEST_F(ImportTest, RejectsPlacesThatAreNotOnEarthAndNegativeVariances) {
  EXPECT_THAT([&] { Import(Gnss("{column: lat,", "{column: rpm,")); },
              ThrowsFault(FaultKind::kOutOfRange, "log.csv:4: column 'rpm'"));
  EXPECT_THAT([&] { Import(Gnss("{column: lon,", "{column: ms,")); },
              ThrowsFault(FaultKind::kOutOfRange, "log.csv:2: column 'ms'"));
  EXPECT_THAT([&] { Import(Gnss("var_u: {constant: 0.0016}", "var_u: {column: gz, unit: m2}")); },
              ThrowsFault(FaultKind::kOutOfRange, "log.csv:4: column 'gz'"));
  EXPECT_THAT([&] { Import(Gnss("var_u: {constant: 0.0016}", "var_u: {constant: -1}")); },
              ThrowsFault(FaultKind::kOutOfRange, "var_u.constant"));
}

TEST_F(ImportTest, RejectsNamesThatLeaveTheRecording) {
  const auto rejects = [&](const std::string& channels, const std::string& place) {
    EXPECT_THAT([&] { Import(channels); }, ThrowsMessage<InputError>(HasSubstr(place))) << channels;
  };
  const std::string table = ", columns: {v: {column: n, unit: '1'}}}]\n";
  rejects("tables: [{name: ../../t" + table, "tables[0].name: name '../../t' cannot name");
  rejects("tables: [{name: /tmp/t" + table, "tables[0].name: name '/tmp/t' cannot name");
  rejects("tables: [{name: t, columns: {'a,b': {column: n, unit: '1'}}}]\n", "name 'a,b' cannot");
  rejects("tables: [{name: t, columns: {t_ns: {column: n, unit: '1'}}}]\n", "columns.t_ns: ");
  rejects(Gnss("name: gnss", "name: .."), "gnss[0].name: name '..' cannot name");
  rejects("encoders: [{name: e, joints: [{name: a b, rate: {column: rpm, unit: rpm}}]}]\n",
          "joints[0].name: name 'a b' cannot name");
  for (const char* machine : {"..", "a/b", "truth"}) {
    WriteWholeFile(scratch_.path() / "mapping.yaml", Top() + Gnss());
    EXPECT_THAT(
        [&] {
          ImportCsv(scratch_.path() / "mapping.yaml", scratch_.path() / "out",
                    {.overrides = {std::string("machine=") + machine}});
        },
        ThrowsMessage<InputError>(HasSubstr("machine: ")));
  }
}

TEST_F(ImportTest, RejectsTwoChannelsOrTwoJointsOfOneName) {
  EXPECT_THAT([&] { Import(Gnss() + "imus:\n  - name: gnss\n    columns: {}\n"); },
              ThrowsFault(FaultKind::kInconsistent, "gnss[0].name"));
  EXPECT_THAT(
      [&] {
        Import(
            "encoders: [{name: e, joints: [{name: j, rate: {column: rpm, unit: rpm}}, "
            "{name: j, rate: {column: rpm, unit: rpm}}]}]\n");
      },
      ThrowsFault(FaultKind::kInconsistent, "joints[1].name"));
}

TEST_F(ImportTest, ReadsTravelAndSpeedOfAPrismaticJoint) {
  const Recording recording = Import(
      "encoders: [{name: e, joints: [{name: stick, travel: {column: east_mm, unit: mm}, speed: "
      "{column: rpm, unit: km/h}}, {name: slide, speed: {column: rpm, unit: m/s}}]}]\n");
  const EncoderRecording encoder = recording.LoadEncoder("digger/e");
  EXPECT_THAT(encoder.axes,
              testing::ElementsAre(EncoderAxis{"stick", true}, EncoderAxis{"slide", true}));
  EXPECT_NEAR(encoder.samples[3].q_rad[0], 1.0, kTight);
  EXPECT_NEAR(encoder.samples[0].qd_radps[0], 60 / 3.6, kTight);
  EXPECT_NEAR(encoder.samples[1].q_rad[1], 6.0, kTight);
  EXPECT_THAT(ReadWholeFile(scratch_.path() / "out/digger/e/data.csv"),
              testing::StartsWith("t_ns,stick_m,slide_m,stick_mps,slide_mps\n"));
}

TEST_F(ImportTest, SaysOfASensorWhatMappingAndDataKnow) {
  std::string imu = kImu;
  imu.replace(imu.find("    rpy_deg"), 0,
              "    mount: {link: boom, xyz_m: [1, 2, 3], rpy_deg: [0, 0, 90]}\n");
  const Recording recording = Import(imu + Gnss());
  EXPECT_DOUBLE_EQ(recording.info().duration_s, 0.3);
  const std::string text = ReadWholeFile(scratch_.path() / "out/digger/imu/sensor.yaml");
  EXPECT_THAT(text, testing::StartsWith("type: imu\nname: imu\nparent_link: boom\n"));
  EXPECT_THAT(text, AllOf(HasSubstr("xyz_m: [1, 2, 3]\n"), HasSubstr("rate_hz: 10\n"),
                          HasSubstr("imported_from: \"log.csv\"\n")));
  const auto imu_rows = recording.LoadImu("digger/imu");
  EXPECT_TRUE(imu_rows[0].w_WS_S_radps.isApprox(Vec3(0, kPi / 2, 0), kTight));
  EXPECT_EQ(ReadWholeFile(scratch_.path() / "out/digger/gnss/sensor.yaml"),
            "type: gnss\nname: gnss\nrate_hz: 10\nimported_from: \"log.csv\"\n");
}

TEST_F(ImportTest, ReadsEachChannelFromItsOwnFileAndTime) {
  WriteWholeFile(scratch_.path() / "other.csv", "t,v\n5,1\n6,2\n");
  const Recording recording = Import(
      "simulated: true\ntables:\n  - name: t\n    file: other.csv\n"
      "    time: {column: t, unit: s}\n    columns: {v_mps: {column: v, unit: km/h, scale: "
      "3.6}}\n");
  EXPECT_TRUE(recording.info().simulated);
  const TableRecording table = recording.LoadTable("digger/t.csv");
  EXPECT_EQ(table.t_ns[1], 6 * kNsPerSecond);
  EXPECT_NEAR(table.rows[1][0], 2.0, kTight);
}

TEST_F(ImportTest, RejectsAUnitOfAnotherDimension) {
  EXPECT_THAT(
      [&] { Import("encoders: [{name: e, joints: [{name: j, rate: {column: rpm, unit: m}}]}]\n"); },
      ThrowsFault(FaultKind::kNoSuchName, "joints[0].rate.unit"));
}

TEST_F(ImportTest, LeavesNothingBehindAfterABadFile) {
  EXPECT_THAT([&] { Import("tables: [{name: t, columns: {v: {column: gxx, unit: m}}}]\n"); },
              ThrowsFault(FaultKind::kNoSuchName, "log.csv:1"));
  EXPECT_THAT([&] { Import("tables: [{name: t, columns: {v: {column: state, unit: m}}}]\n"); },
              ThrowsFault(FaultKind::kMistyped, "log.csv:2: column 'state'"));
  EXPECT_THAT([&] { Import(kPose); }, ThrowsFault(FaultKind::kOutOfRange, "log.csv:2"));
  EXPECT_FALSE(fs::exists(scratch_.path() / "out"));
  EXPECT_FALSE(fs::exists(scratch_.path() / "out.incomplete"));
}

TEST_F(ImportTest, OverAnIncompleteRecordingSaysThatItMustBeDeletedFirst) {
  // State after a killed import.
  fs::create_directory(scratch_.path() / "out.incomplete");
  WriteWholeFile(scratch_.path() / "out.incomplete/INCOMPLETE.txt", "killed");
  EXPECT_THAT([&] { Import("tables: [{name: t, columns: {v: {column: gx, unit: deg/s}}}]\n"); },
              ThrowsMessage<InputError>(HasSubstr(
                  "out.incomplete: holds an incomplete recording; delete it and import it again")));
}

TEST_F(ImportTest, RejectsTimesThatDoNotIncrease) {
  WriteWholeFile(scratch_.path() / "log.csv", "ms,v\n1,0\n2,0\n2,0\n");
  EXPECT_THAT([&] { Import("tables: [{name: t, columns: {v: {column: v, unit: m}}}]\n"); },
              ThrowsFault(FaultKind::kInconsistent, "log.csv:4: column 'ms'"));
}

TEST(DriveWarthogMapping, ImportsARowBeforeAndAfterTheFirstReferencePose) {
  ScratchDirectory scratch;
  WriteWholeFile(
      scratch.path() / "asphalt.csv",
      "t_s,calib_state,icp_index,calib_step,meas_left_vel,meas_right_vel,cmd_vel_x,cmd_vel_omega,"
      "icp_pos_x,icp_pos_y,icp_pos_z,icp_quat_x,icp_quat_y,icp_quat_z,icp_quat_w,imu_x,imu_y,"
      "imu_z,imu_acceleration_x,imu_acceleration_y,imu_acceleration_z\n"
      "0.0,,0.0,0,0,0,0,0,0,0,0,0,0,0,1,0,0,0,0,0,0\n"
      "0.05,,1.0,0,1.5,2.5,0.5,-0.25,1,2,3,0,0,0.6,0.8,0.1,0.2,0.3,1,2,9\n"
      "0.1,,1.0,0,1.5,2.5,0.5,-0.25,1,2,3,0,0,0.6,0.8,0.1,0.2,0.3,1,2,9\n"
      "0.15,,2.0,0,1.5,2.5,0.5,-0.25,2,2,3,0,0,0.6,0.8,0.1,0.2,0.3,1,2,9\n");
  ImportCsv(DataRoot() / "config/import/drive_warthog.yaml", scratch.path() / "out",
            {.overrides = {"file=" + (scratch.path() / "asphalt.csv").string()}});
  const Recording recording(scratch.path() / "out");
  EXPECT_EQ(recording.LoadPose("truth/warthog/pose.csv").poses.size(), 2u);
  EXPECT_EQ(recording.LoadImu("warthog/imu").size(), 3u);
  EXPECT_EQ(recording.LoadEncoder("warthog/wheels").samples.at(1).qd_radps.at(1), 2.5);
  EXPECT_EQ(recording.LoadTable("warthog/cmd_vel.csv").rows.at(1).at(1), -0.25);
}

}  // namespace
}  // namespace tera
