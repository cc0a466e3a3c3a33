#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/refused.h"
#include "core/faults.h"

// `tera lint` from a user's view, on the program's own output.

namespace tera {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

/// A digging excavator with one sensor of each kind and every label.
constexpr const char* kLintCommandExcavator = R"(name: small
seed: 5
duration_s: 1.2
site: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90}
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
RECORD
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [0, 0], yaw_deg: 30, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: random_levers}
    rig: {sensors: [
      {name: imu_base, preset: tera:config/sensors/xsens_mti_670.yaml, link: undercarriage, rpy_deg: [0, 10, 20]},
      {name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.5], rpy_deg: [0, 10, 20]},
      {name: joints, preset: tera:config/sensors/encoder.yaml},
      {name: tilt, preset: tera:config/sensors/inclinometer.yaml, link: upper},
      {name: gnss_left, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2]},
      {name: camera, preset: tera:config/sensors/realsense_d435i.yaml, link: upper, xyz_m: [0.8, 0, 2], rpy_deg: [0, 15, 0],
       width_px: 96, height_px: 72, rate_hz: 5, labels: [semantic, instance, normal, distance, flow_to_previous,
       flow_to_this, scene_flow_to_previous, ground_soil, ground_state, ground_change, ground_age]},
      {name: fish, preset: tera:config/sensors/rgb_fisheye.yaml, link: upper, xyz_m: [0.8, 0, 2], width_px: 96,
       height_px: 72, rate_hz: 5},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0, 2], columns: 128}]}
obstacles:
  - {name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [4, 3]}
  - {name: person1, preset: tera:config/obstacles/person.yaml, xy_m: [5, 1], path: [{t_s: 0, xy_m: [5, 1]}, {t_s: 3, xy_m: [5, 3]}]}
)";

class LintCommand : public testing::Test {
 protected:
  Outcome Run(const Arguments& arguments) const { return RunTera(arguments, {scratch_.path()}); }
  fs::path Path(const std::string& file) const { return scratch_.path() / file; }
  void Made(const Arguments& arguments) const {
    const Outcome made = Run(arguments);
    ASSERT_EQ(made.status, 0) << made.err;
  }
  void ExpectClean(const std::string& dataset) const {
    const Outcome outcome = Run({"lint", dataset, "--strict"});
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith(dataset + ": clean; "));
  }
  ScratchDirectory scratch_;
};

TEST_F(LintCommand, WhatIsGeneratedIsClean) {
  WriteWholeFile(Path("small.yaml"),
                 Edited(kLintCommandExcavator, "RECORD", "record: {poses_hz: 50}"));
  Made({"generate", "small.yaml", "--out", "run"});
  ExpectClean("run");
  // Every rule except that of hashes applies.
  Made({"lint", "run", "--json", "lint.json"});
  const json report = json::parse(ReadWholeFile(Path("lint.json")));
  EXPECT_EQ(report["not_applicable"], json({"dataset.epoch", "files.hash"}));
}

TEST_F(LintCommand, WhatIsGeneratedWithoutPosesOfSensorsIsClean) {
  WriteWholeFile(Path("small.yaml"), Edited(kLintCommandExcavator, "RECORD", ""));
  Made({"generate", "small.yaml", "--out", "run"});
  ExpectClean("run");
}

TEST_F(LintCommand, ARealRecordingThatIsImportedIsClean) {
  Made({"import", TERA_SOURCE_DIR "/config/import/drive_warthog.yaml", "--out", "real"});
  ExpectClean("real");
}

TEST_F(LintCommand, EndsWithOneWhereThereAreErrors) {
  WriteWholeSample(Path("run"), {});
  WriteWholeFile(Path("run/digger/commands.csv"), "t_ns,boom\n0,7\n");
  const Outcome outcome =
      Run({"lint", "run", "--sarif", "lint.sarif", "--statistics", "page.html"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("error commands.range in digger/commands.csv"));
  EXPECT_EQ(json::parse(ReadWholeFile(Path("lint.sarif")))["version"], "2.1.0");
  EXPECT_THAT(ReadWholeFile(Path("page.html")), HasSubstr("commands.range"));
}

TEST_F(LintCommand, WarningsCountWhereItIsStrict) {
  Made({"import", TERA_SOURCE_DIR "/config/import/drive_warthog.yaml", "--out", "real"});
  WriteWholeFile(Path("real/notes.txt"), "x");
  EXPECT_EQ(Run({"lint", "real"}).status, 0);
  EXPECT_EQ(Run({"lint", "real", "--strict"}).status, 1);
}

TEST_F(LintCommand, HashesAreWrittenOfWhatIsRightAndHeldToAfterwards) {
  Made({"import", TERA_SOURCE_DIR "/config/import/drive_warthog.yaml", "--out", "real"});
  const Outcome written = Run({"lint", "real", "--write-hashes"});
  EXPECT_EQ(written.status, 0) << written.out;
  EXPECT_THAT(written.out, HasSubstr("frames.sha256: 8 files\n"));
  ExpectClean("real");
  const std::string sheet = ReadWholeFile(Path("real/warthog/imu/sensor.yaml"));
  WriteWholeFile(Path("real/warthog/imu/sensor.yaml"), sheet + "# seen\n");
  const Outcome changed = Run({"lint", "real", "--write-hashes"});
  EXPECT_EQ(changed.status, 1);
  EXPECT_THAT(changed.out, AllOf(HasSubstr("error files.hash"), HasSubstr("not written")));
}

TEST_F(LintCommand, RefusesWhatIsNoDataset) {
  ExpectRefused(scratch_, {"lint", "nothing"}, TellsOf("nothing"));
  ExpectRefused(scratch_, {"lint"}, TellsOf("DATASET"));
  const Outcome sample = Run({"lint", "x", "--sample", "0"});
  EXPECT_EQ(sample.status, 2);
  EXPECT_THAT(sample.err, TellsOf("--sample"));
}

TEST_F(LintCommand, ListsItsRules) {
  const Outcome outcome = Run({"lint", "--rules"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("| `stamps.increasing` | error | "));
}

}  // namespace
}  // namespace tera
