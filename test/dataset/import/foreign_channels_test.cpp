#include "dataset/import/foreign_csv.h"

/// Channels from tables, by a mapping.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST_F(ForeignCsv, EmptyFieldsOfSlowerChannelsAreNoRows) {
  Log("t,x,y,z\n0,1.5,-2,1\n0.1,,,2\n0.2,nan,1,3\n1,3,4e-3,\n");
  EXPECT_THAT([&] { Import(kSeconds + Table("x", "y")); },
              ThrowsFault(FaultKind::kMissing, "log.txt:3: column 'x'"));
  Import(std::string(kSeconds) +
         "tables: [{name: levels, valid_if: [{column: x, present: true}], columns: {a: {column: x, "
         "unit: '1'}, b: {column: y, unit: '1'}}}]\n");
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, RuleOnAFieldWithoutANumberDoesNotHold) {
  Log("t,x,y,ok\n0,1.5,-2,1\n0.5,7,7,\n1,3,4e-3,1\n");
  Import(std::string(kSeconds) +
         "tables: [{name: levels, valid_if: [{column: ok, equals: 1}], columns: {a: {column: x, "
         "unit: '1'}, b: {column: y, unit: '1'}}}]\n");
  EXPECT_EQ(Rows(), kTwoRows);
}

TEST_F(ForeignCsv, CheckAndSkippingKnowQuaternions) {
  Log("t,x,w\n0,1,1\n1,2,0.5\n2,3,-1\n");
  const std::string keys =
      std::string(kSeconds) +
      "pose: {columns: {x: {column: x, unit: m}, y: {constant: 0}, z: {constant: 0}, qw: {column: "
      "w, "
      "unit: '1'}, qx: {constant: 0}, qy: {constant: 0}, qz: {constant: 0}}}\n";
  for (const bool checks_only : {true, false}) {
    EXPECT_THAT([&] { Import(keys, {.checks_only = checks_only}); },
                ThrowsFault(FaultKind::kOutOfRange, "log.txt:3"));
  }
  const ImportReport report = Import(keys, {.skips_bad_rows = true});
  EXPECT_EQ(report.channels[0].left_out, 1);
  EXPECT_EQ(Recording(Out()).LoadPose("truth/digger/pose.csv").poses.size(), 2u);
}

TEST_F(ForeignCsv, LeversAHairBeyondFullAreFull) {
  Log("t,x,y\n0,1.000001,-1.00005\n1,0.5,1.3\n");
  const ImportReport report = Import(kSeconds + Table("x", "y", "commands"));
  EXPECT_EQ(Rows("commands"), (std::vector<std::vector<double>>{{1, -1}, {0.5, 1.3}}));
  EXPECT_EQ(report.channels[0].clamped_levers, 2);
  EXPECT_EQ(report.channels[0].levers_beyond_full, 1);
  EXPECT_EQ(report.channels[0].largest_lever, 1.3);
}

TEST_F(ForeignCsv, WayRolledBesideATravelIsRefused) {
  Log("t,odo\n0,100\n1,350\n");
  EXPECT_THAT(
      [&] {
        Import(std::string(kSeconds) +
               "encoders: [{name: e, joints: [{name: a, rolled: {column: odo, unit: cm}, radius_m: "
               "0.5, "
               "travel: {column: odo, unit: m}}]}]\n");
      },
      ThrowsFault(FaultKind::kInconsistent, "joints[0].travel"));
}

TEST_F(ForeignCsv, WayRolledIsAnAngle) {
  Log("t,odo\n0,100\n1,350\n");
  Import(std::string(kSeconds) +
         "encoders: [{name: wheels, joints: [{name: left, rolled: {column: odo, unit: cm}, "
         "radius_m: 0.5}]}]\n");
  const auto samples = Recording(Out()).LoadEncoder("digger/wheels").samples;
  EXPECT_NEAR(samples[0].q_rad[0], 2, 1e-12);
  EXPECT_NEAR(samples[1].q_rad[0], 7, 1e-12);
  EXPECT_NEAR(samples[0].qd_radps[0], 5, 1e-12);
}

TEST_F(ForeignCsv, StrokeNeedsAMachine) {
  Log("t,s\n0,0.1\n1,0.2\n");
  EXPECT_THAT(
      [&] {
        Import(std::string(kSeconds) +
               "encoders: [{name: e, joints: [{name: boom, stroke: {column: s, unit: m}}]}]\n");
      },
      ThrowsFault(FaultKind::kInconsistent, "joints[0].stroke"));
}

TEST_F(ForeignCsv, CheckWritesNothing) {
  Log("t,x,y\n0,1,1\n0.1,1,1\n0.2,1,1\n0.9,1,1\n1,1,1\n");
  const ImportReport report = Import(kSeconds + Table("x", "y"), {.checks_only = true});
  EXPECT_FALSE(fs::exists(Out()));
  ASSERT_EQ(report.channels.size(), 1u);
  EXPECT_EQ(report.channels[0].rows, 5);
  EXPECT_EQ(report.channels[0].interval_ns, 100'000'000);
  EXPECT_EQ(report.channels[0].longest_gap_ns, 700'000'000);
  EXPECT_EQ(report.channels[0].irregular, 1);
}

TEST_F(ForeignCsv, AGyroOfOneAxisIsAChannelOfItsOwn) {
  Log("t,rate\n0,90\n1,-45\n");
  Import(std::string(kSeconds) +
         "gyros: [{name: cab, mount: {link: upper, xyz_m: [0, 0, 1], rpy_deg: [0, 0, 0]}, columns: "
         "{wz: {column: rate, unit: deg/s}}}]\n");
  const Recording recording(Out());
  EXPECT_EQ(recording.TypeOf("digger/cab"), "gyro");
  const TableRecording rows = recording.LoadRows("digger/cab");
  EXPECT_EQ(rows.columns, (std::vector<std::string>{"wz_radps"}));
  EXPECT_NEAR(rows.rows[1][0], -0.78539816339744831, 1e-15);
  EXPECT_THAT(ReadWholeFile(Out() / "digger/cab/sensor.yaml"), HasSubstr("parent_link: upper"));
  EXPECT_THAT(recording.SeriesChannels(), ::testing::Contains("digger/cab"));
  EXPECT_THAT([&] { Import(std::string(kSeconds) + "gyros: [{name: cab, columns: {}}]\n"); },
              ThrowsFault(FaultKind::kInconsistent, "columns"));
  EXPECT_THAT(
      [&] {
        Import(std::string(kSeconds) +
               "gyros: [{name: cab, columns: {w: {column: rate, unit: deg/s}}}]\n");
      },
      ThrowsFault(FaultKind::kUnknown, "columns.w"));
}

TEST_F(ForeignCsv, ALeverOfTwoDirectionsIsTheirDifference) {
  Log("t,up,down\n0,25,0\n1,0,100\n");
  Import(std::string(kSeconds) +
         "tables: [{name: commands, columns: {boom: {sum: [{column: up, unit: \"%\"}, {column: "
         "down, unit: \"%\", scale: -1}]}}}]\n");
  EXPECT_EQ(Rows("commands"), (std::vector<std::vector<double>>{{0.25}, {-1}}));
  EXPECT_THAT(
      [&] { Import(std::string(kSeconds) + "tables: [{name: c, columns: {b: {sum: []}}}]\n"); },
      ThrowsFault(FaultKind::kMissing, "columns.b.sum"));
}

TEST_F(ForeignCsv, RowsAreChosenByAText) {
  Log("t,signal,value\n0,boom,20\n0.5,arm,-60\n1,boom,21\n1.5,bucket 2,4\n");
  const auto table = [](const std::string& signal) {
    return "tables: [{name: levels, valid_if: [{column: signal, equals: " + signal +
           "}], columns: {a: {column: value, unit: '1'}}}]\n";
  };
  Import(kSeconds + table("boom"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{20}, {21}}));
  Import(kSeconds + table("bucket 2"));
  EXPECT_EQ(Rows(), (std::vector<std::vector<double>>{{4}}));
}

class ForeignCsvFiles : public ForeignCsv {
 protected:
  ForeignCsvFiles() {
    WriteWholeFile(scratch_.path() / "a.csv", "t,x,y\n0,1.5,-2\n");
    WriteWholeFile(scratch_.path() / "b.csv", "t,x,y\n1,3,4e-3\n");
  }
  ImportReport ImportBoth(const std::string& keys = kSeconds, ImportOptions options = {}) {
    WriteWholeFile(
        scratch_.path() / "mapping.yaml",
        "name: logged\nmachine: digger\nfile: [a.csv, b.csv]\n" + keys + Table("x", "y"));
    fs::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }
};

TEST_F(ForeignCsvFiles, AreJoinedInTheirOrder) {
  ImportBoth();
  EXPECT_EQ(Rows(), kTwoRows);
  ImportBoth("time: {interval: 20, unit: ms}\n");
  EXPECT_EQ(Times(), kTwentyMs);
  EXPECT_THAT(ReadWholeFile(Out() / "dataset.yaml"), AllOf(HasSubstr("a.csv"), HasSubstr("b.csv")));
}

TEST_F(ForeignCsvFiles, MustHaveTheSameColumnsAndTimesThatGoOn) {
  WriteWholeFile(scratch_.path() / "b.csv", "t,y,x\n1,3,4e-3\n");
  EXPECT_THAT([&] { ImportBoth(); }, ThrowsFault(FaultKind::kInconsistent, "b.csv"));
  WriteWholeFile(scratch_.path() / "b.csv", "t,x,y\n\n0,3,4e-3\n");
  EXPECT_THAT([&] { ImportBoth(); }, ThrowsFault(FaultKind::kInconsistent, "b.csv:3: column 't'"));
  WriteWholeFile(scratch_.path() / "b.csv", "t,x,y\n1,oh,4e-3\n");
  EXPECT_THAT([&] { ImportBoth(); }, ThrowsFault(FaultKind::kMistyped, "b.csv:2: column 'x'"));
}

// --- Places.

class ForeignPlace : public ForeignCsv {
 protected:
  std::vector<GnssSample> Fixes(const std::string& lat, const std::string& lon) {
    report_ = Import(std::string(kSeconds) +
                     "origin: {lat_deg: -48.125, lon_deg: 11.5, height_m: 500}\n"
                     "gnss: [{name: rover, columns: {lat: {column: lat, " +
                     lat + "}, lon: {column: lon, " + lon +
                     "}, alt: {constant: 500}, fix: {constant: 4}, var_e: {constant: 1}, var_n: "
                     "{constant: 1}, var_u: {constant: 1}}}]\n");
    return Recording(Out()).LoadGnss("digger/rover");
  }
  ImportReport report_;
};

TEST_F(ForeignPlace, DegreesAndMinutesHaveAUnitAndHemispheresAColumn) {
  Log("t,lat,ns,lon\n0,4807.5,S,1130.0\n1,4807.6,S,1130.0\n");
  const auto fixes = Fixes("unit: ddmm, hemisphere: ns", "unit: ddmm");
  EXPECT_NEAR(fixes.at(0).lat_deg, -48.125, 1e-12);
  EXPECT_NEAR(fixes.at(1).lat_deg, -(48 + 7.6 / 60), 1e-12);
  EXPECT_NEAR(fixes.at(0).lon_deg, 11.5, 1e-12);
  Log("t,lat,ns,lon\n0,-4807.5,X,1199.0\n");
  EXPECT_THAT([&] { Fixes("unit: ddmm, hemisphere: ns", "unit: ddmm"); },
              ThrowsFault(FaultKind::kNoSuchName, "log.txt:2: column 'ns'"));
  EXPECT_THAT([&] { Fixes("unit: ddmm", "unit: ddmm"); },
              ThrowsFault(FaultKind::kOutOfRange, "log.txt:2: column 'lon'"));
}

TEST_F(ForeignPlace, RowsAtZeroZeroAreWithoutAFixAndTold) {
  Log("t,lat,lon\n0,0,0\n1,-48.125,11.5\n2,0,0\n");
  const auto fixes = Fixes("unit: deg", "unit: deg");
  ASSERT_EQ(fixes.size(), 3u);
  EXPECT_EQ(fixes[0].fix, GnssFix::kNone);
  EXPECT_EQ(fixes[1].fix, GnssFix::kRtkFixed);
  ASSERT_EQ(report_.channels.at(0).remarks.size(), 1u);
  EXPECT_THAT(report_.channels[0].remarks[0], ::testing::StartsWith("2 rows"));
}

}  // namespace
}  // namespace tera
