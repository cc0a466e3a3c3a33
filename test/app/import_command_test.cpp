#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/program.h"
#include "core/faults.h"
#include "core/units.h"
#include "dataset/format/recording.h"

// `tera import` from a user's view; test/dataset/import covers the forms of files.

namespace tera {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr char kStrokes[] = R"(name: dig
machine: digger
file: log.csv
time: {column: t, unit: s}
machine_model: tera:config/machines/tb235.yaml
encoders: [{name: arms, joints: [{name: arm, stroke: {column: arm_mm, unit: mm}}]}]
)";

TEST(ImportCommand, StrokeOfACylinderBecomesItsJointsAngle) {
  // Strokes and angles of a run, from the simulation itself: hydraulics.csv has the length between
  // a cylinder's pins beyond the shortest, joints.csv the angle.
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "run.yaml", R"(name: run
duration_s: 0.1
settle_s: 0
terrain: {size_m: [12, 12], cell_m: 0.1, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {arm: -70}}
    operator: {type: idle}
    rig: {sensors: []}
)");
  ASSERT_EQ(RunTera({"generate", "run.yaml", "--out", "run"}, {scratch.path()}).status, 0);
  const Recording run(scratch.path() / "run");
  const TableRecording cylinders = run.LoadTable("truth/excavator1/hydraulics.csv");
  const TableRecording joints = run.LoadTable("truth/excavator1/joints.csv");
  const auto value = [](const TableRecording& table, const std::string& column) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), column);
    EXPECT_NE(found, table.columns.end()) << column;
    return table.rows.front()[static_cast<std::size_t>(found - table.columns.begin())];
  };
  const double stroke_m = value(cylinders, "arm_cylinder_stroke_m");
  WriteWholeFile(scratch.path() / "mapping.yaml", kStrokes);
  WriteWholeFile(scratch.path() / "log.csv",
                 "t,arm_mm\n0," + std::to_string(1000 * stroke_m) + "\n0.1,0\n");
  const Outcome outcome = RunTera({"import", "mapping.yaml", "--out", "in"}, {scratch.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const EncoderRecording in = Recording(scratch.path() / "in").LoadEncoder("digger/arms");
  EXPECT_NEAR(in.samples[0].q_rad[0], value(joints, "arm_rad"), 1e-5);
  EXPECT_GT(std::abs(in.samples[1].q_rad[0] - in.samples[0].q_rad[0]), 10 * kDeg);
}

TEST(ImportCommand, StrokesThatTheMachineCannotHaveAreTold) {
  // The unit of one reading is another sensor's: centimetres read as millimetres would fit, metres
  // do not.
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "mapping.yaml", kStrokes);
  WriteWholeFile(scratch.path() / "log.csv", "t,arm_mm\n0,300\n0.1,3000\n0.2,3100\n");
  const Outcome outcome = RunTera({"import", "mapping.yaml", "--check"}, {scratch.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n  2 strokes beyond the joint's travel, by up to 2."));
}

TEST(ImportCommand, StrokeOfAJointWithoutACylinderIsRefused) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "mapping.yaml", kStrokes);
  WriteWholeFile(scratch.path() / "log.csv", "t,arm_mm\n0,1\n");
  const Outcome outcome =
      RunTera({"import", "mapping.yaml", "--out", "in", "--set", "encoders[0].joints[0].name=slew"},
              {scratch.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no cylinder of the machine model moves a joint 'slew'"));
  EXPECT_FALSE(fs::exists(scratch.path() / "in"));
}

TEST(ImportCommand, TellsWhatItHasRead) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "mapping.yaml", R"(name: dig
machine: digger
file: log.csv
time: {column: t, unit: ms}
tables: [{name: commands, columns: {boom: {column: boom, unit: "1"}}}]
)");
  WriteWholeFile(scratch.path() / "log.csv",
                 "t;boom\n0;0\n10;1.00002\n20;55\n25;x\n30;0\n90;0\n100");
  const Outcome outcome =
      RunTera({"import", "mapping.yaml", "--check", "--skip-bad-rows"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(ContainsRegex("digger/commands.csv +5 +100 Hz"),
                                 HasSubstr("2 rows left out, the first: "), HasSubstr("log.csv:8"),
                                 HasSubstr("1 intervals differ"), HasSubstr("0.06 s"),
                                 HasSubstr("1 lever values slightly beyond full"),
                                 HasSubstr("1 lever values beyond full, up to 55")));
  EXPECT_FALSE(fs::exists(scratch.path() / "in"));
}

// A log without levers: commanded speeds, an angle, a pose, and a pressure. All of it is kept in SI
// units, compared with another log, drawn, and put into a bag.
TEST(ImportCommand, SetPointsOfALogWithoutLeversAreKeptComparedDrawnAndExported) {
  const ScratchDirectory scratch;
  for (const char* run : {"a", "b"}) {
    WriteWholeFile(scratch.path() / (std::string(run) + ".yaml"), fmt::format(R"(name: {0}
machine: digger
file: {0}.csv
time: {{column: t, unit: s}}
tables:
  - name: setpoints
    columns: {{forward_mps: {{column: v, unit: km/h}}, boom_rad: {{column: boom, unit: deg}}, x_m: {{column: x, unit: cm}}}}
  - name: pressures
    columns: {{boom_head_pa: {{column: p, unit: bar}}}}
)",
                                                                              run));
    WriteWholeFile(
        scratch.path() / (std::string(run) + ".csv"),
        fmt::format("t,v,boom,x,p\n0,3.6,90,100,{0}\n1,7.2,45,200,{0}\n", *run == 'a' ? 100 : 130));
    const Outcome outcome =
        RunTera({"import", std::string(run) + ".yaml", "--out", run}, {scratch.path()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  const TableRecording points = Recording(scratch.path() / "a").LoadTable("digger/setpoints.csv");
  ASSERT_EQ(points.rows.size(), 2u);
  EXPECT_NEAR(points.rows[1][0], 2, 1e-12);
  EXPECT_NEAR(points.rows[0][1], kPi / 2, 1e-12);
  EXPECT_NEAR(points.rows[0][2], 1, 1e-12);
  const Outcome compared = RunTera({"compare", "a", "b"}, {scratch.path()});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_THAT(compared.out, AllOf(ContainsRegex("setpoints forward_mps +0 +0 +2"),
                                  ContainsRegex("pressures boom_head_pa +3e\\+06 +3e\\+06 +2")));
  EXPECT_EQ(RunTera({"overview", "a", "--image", "a.png"}, {scratch.path()}).status, 0);
  const Outcome exported =
      RunTera({"export", "a", "--to", "rosbag2", "--out", "bag"}, {scratch.path()});
  EXPECT_EQ(exported.status, 0) << exported.err;
  EXPECT_THAT(
      ReadWholeFile(scratch.path() / "bag/metadata.yaml"),
      AllOf(HasSubstr("name: /digger/setpoints\n"), HasSubstr("name: /digger/pressures\n")));
}

TEST(ImportCommand, SuggestedMappingOfABagIsOneThatItTakes) {
  // A mast has no joints, but a topic of that kind.
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "run.yaml", R"(name: run
duration_s: 0.2
settle_s: 0
terrain: {size_m: [12, 12], cell_m: 0.1, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    operator: {type: idle}
    rig: {sensors: [{name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom}]}
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [4, -4]}
    operator: {type: idle}
    rig: {sensors: []}
)");
  ASSERT_EQ(RunTera({"generate", "run.yaml", "--out", "run"}, {scratch.path()}).status, 0);
  const Outcome made =
      RunTera({"export", "run", "--to", "rosbag2", "--out", "bag"}, {scratch.path()});
  ASSERT_EQ(made.status, 0) << made.err;
  const Outcome suggested = RunTera({"import", "--suggest", "bag"}, {scratch.path()});
  ASSERT_EQ(suggested.status, 0) << suggested.err;
  EXPECT_THAT(suggested.out, HasSubstr("topic: \"/excavator1/joint_states\""));
  WriteWholeFile(scratch.path() / "mapping.yaml", suggested.out);
  const Outcome in = RunTera({"import", "mapping.yaml", "--out", "in"}, {scratch.path()});
  ASSERT_EQ(in.status, 0) << in.err;
  EXPECT_EQ(Recording(scratch.path() / "in").LoadImu("machine/excavator1_imu_boom").size(),
            Recording(scratch.path() / "run").LoadImu("excavator1/imu_boom").size());
}

/// Files of two loggers on a boom that moves in bumps. One has its gyro at 50 Hz, the other its
/// encoder, with a clock that is 3 s ahead and gains 50 ppm. `other` has different bumps.
void WriteTwoLogs(const fs::path& folder, bool other) {
  const auto rate_radps = [](double t_s, unsigned seed) {
    double sum = 0;
    for (unsigned k = 0; k < 40; ++k) {  // a bump about every three seconds
      seed = seed * 1664525u + 1013904223u;
      const double place = seed / 4294967296.0;
      seed = seed * 1664525u + 1013904223u;
      const double height = seed / 4294967296.0 - 0.5;
      const double u = (t_s - 3 * (k + place)) / 0.6;
      sum += height * std::exp(-0.5 * u * u);
    }
    return sum;
  };
  std::string gyro = "t,wx,wy,wz\n", encoder = "t,boom\n";
  for (int k = 0; k < 6000; ++k) {
    const double t_s = 0.02 * k;
    gyro += fmt::format("{},0,{},0\n", t_s, rate_radps(t_s, 1));
    encoder += fmt::format("{},{}\n", 3 + t_s * (1 + 50e-6), rate_radps(t_s, other ? 2 : 1));
  }
  WriteWholeFile(folder / "gyro.csv", gyro);
  WriteWholeFile(folder / "encoder.csv", encoder);
  WriteWholeFile(folder / "clocks.yaml", R"(name: two
machine: digger
time: {column: t, unit: s}
gyros: [{name: gyro, file: gyro.csv, columns: {wy: {column: wy, unit: rad/s}}}]
encoders: [{name: joints, file: encoder.csv, joints: [{name: boom, rate: {column: boom, unit: rad/s}}]}]
)");
}

TEST(ImportCommand, ClocksOfTwoLoggersAreComparedAndNotChanged) {
  const ScratchDirectory scratch;
  WriteTwoLogs(scratch.path(), /*other=*/false);
  const Outcome checked = RunTera({"import", "clocks.yaml", "--check"}, {scratch.path()});
  ASSERT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out,
              AllOf(ContainsRegex("clock of digger/joints: [23]\\.[09][0-9]+ \\+- 0\\.0[0-9]+ s "
                                  "ahead of that of digger/gyro at "),
                    HasSubstr("gains "), HasSubstr("the recording is unchanged")));
  const Outcome imported = RunTera({"import", "clocks.yaml", "--out", "in"}, {scratch.path()});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("clock of digger/joints"));
  const EncoderRecording in = Recording(scratch.path() / "in").LoadEncoder("digger/joints");
  EXPECT_EQ(in.samples.front().t_ns, 3 * kNsPerSecond);
  WriteTwoLogs(scratch.path(), /*other=*/true);
  const Outcome others = RunTera({"import", "clocks.yaml", "--check"}, {scratch.path()});
  ASSERT_EQ(others.status, 0) << others.err;
  EXPECT_EQ(others.out.find("clock of"), std::string::npos) << others.out;
}

TEST(ImportCommand, NeedsAPlaceUnlessItOnlyChecks) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "mapping.yaml", kStrokes);
  const Outcome outcome = RunTera({"import", "mapping.yaml"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, TellsOf("--out"));
}

}  // namespace
}  // namespace tera
