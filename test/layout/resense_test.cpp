#include "layout/resense.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/format/sample_recording.h"
#include "sim/scenario/load_scenario.h"
#include "sim/state/state_log.h"

// A recorded scene measured by other rigs: results equal those of a direct run.

namespace tera {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Key;
using testing::ThrowsMessage;
namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

constexpr char kResenseScene[] = R"(
name: scene
seed: 5
duration_s: 0.8
settle_s: 0.1
physics_rate_hz: 200
terrain: {size_m: [14, 14], cell_m: 0.1, soil: loose, relief: {amplitude_m: 0.1, wavelength_m: 5}}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {yaw_deg: 20, joints_deg: {boom: 30, arm: -80, bucket: -60}}
    operator: {type: random_levers, amplitude: 0.8}
    rig: excavator_rig.yaml
  - name: mast1
    machine: tera:config/machines/mast.yaml
    start: {xy_m: [4, -4], yaw_deg: 130}
    operator: {type: idle}
    rig: mast_rig.yaml
obstacles:
  - {name: box1, label: rock, mesh: box.obj, xy_m: [5, 1], yaw_deg: 30,
     collision: [{xyz_m: [0, 0, 0.5], size_m: [1, 1, 1]}]}
  - {name: person1, preset: tera:config/obstacles/person.yaml, xy_m: [4, 3],
     path: [{t_s: 0, xy_m: [4, 3]}, {t_s: 0.6, xy_m: [3.6, 2.5]}]}
record: {every_s: 0.4, poses_hz: 30}
effects: {excavator1: {
  imu: {imu_lever_arm: {x_m: 0.5}, latency: {delay_s: 0.01, jitter_s: 0.05}},
  lidar: {extrinsic: {yaw_deg: 2}, clock_offset: {offset_s: -18}}}}
)";

constexpr char kExcavatorRig[] = R"(sensors:
  - {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3]}
  - {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1], columns: 90}
)";
constexpr char kMastRig[] =
    "sensors: [{name: imu, preset: tera:config/sensors/icm_20948.yaml, link: mast}]\n";

/// Every kind of sensor, with other places and settings than in kExcavatorRig.
constexpr char kOtherRig[] = R"(sensors:
  - {name: imu, preset: tera:config/sensors/icm_20948.yaml, link: arm, xyz_m: [0.5, 0.1, 0.2], rpy_deg: [5, 10, 80]}
  - {name: imu2, preset: tera:config/sensors/xsens_mti_670.yaml, link: bucket}
  - {name: incline, preset: tera:config/sensors/inclinometer.yaml, link: boom}
  - {name: gnss, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2]}
  - {name: encoders, preset: tera:config/sensors/encoder.yaml}
  - {name: camera, preset: tera:config/sensors/realsense_d435i.yaml, link: upper, xyz_m: [0.8, 0.3, 1.8],
     rpy_deg: [0, 30, 0], width_px: 64, height_px: 48, rate_hz: 5, labels: [semantic, instance, normal]}
  - {name: lidar, preset: tera:config/sensors/os1_64.yaml, link: upper, xyz_m: [0, -0.3, 2.4], columns: 64}
  - {name: lidar2, preset: tera:config/sensors/vlp16.yaml, link: arm, xyz_m: [0, 0, 0.6], columns: 90}
)";

constexpr char kBox[] = R"(o body
v -0.5 -0.5 0
v 0.5 -0.5 0
v 0.5 0.5 0
v -0.5 0.5 0
v 0 0 1
f 2 1 4 3
f 1 2 5
f 2 3 5
f 3 4 5
f 4 1 5
)";

class ResenseScene : public testing::Test {
 protected:
  ResenseScene() {
    WriteWholeFile(path() / "scene.yaml", kResenseScene);
    WriteWholeFile(path() / "excavator_rig.yaml", kExcavatorRig);
    WriteWholeFile(path() / "mast_rig.yaml", kMastRig);
    WriteWholeFile(path() / "other_rig.yaml", kOtherRig);
    WriteWholeFile(path() / "box.obj", kBox);
  }

  const fs::path& path() const { return scratch_.path(); }

  Files Generated(const std::string& out, bool keep_state,
                  const std::vector<std::string>& overrides = {}) {
    const LoadedScenario loaded = LoadScenario(path() / "scene.yaml", overrides);
    Generate(loaded.scenario, loaded.resolved_yaml,
             {.out = path() / out, .threads = 1, .keep_state = keep_state});
    return AllFiles(path() / out);
  }
  Files Direct(const std::string& rig, const std::string& machine = "machines[0]") {
    return Generated("direct", false, {machine + ".rig=" + (path() / rig).string()});
  }
  Files Resensed(const ResenseRig& rig, const std::string& out = "resensed") {
    Resense(path() / "base", rig, {}, {.out = path() / out, .threads = 1});
    return AllFiles(path() / out);
  }
  ResenseRig Other() const { return {.file = path() / "other_rig.yaml", .machine = ""}; }

  /// Expects an error with these words, and unchanged files.
  void ExpectRefused(const ResenseRig& rig, const testing::Matcher<std::string>& message) {
    const auto before = AllFiles(path());
    EXPECT_THAT([&] { Resensed(rig); }, ThrowsMessage<InputError>(message));
    EXPECT_FALSE(fs::exists(path() / "resensed"));
    EXPECT_FALSE(fs::exists(path() / "resensed.incomplete"));
    EXPECT_TRUE(AllFiles(path()) == before);
  }

  const ScratchDirectory scratch_;
};

void ExpectSame(const Files& a, const Files& b) {
  for (const auto& [name, bytes] : a) {
    const auto other = b.find(name);
    ASSERT_TRUE(other != b.end()) << name;
    EXPECT_TRUE(other->second == bytes) << name << " differs";
  }
  for (const auto& [name, bytes] : b) EXPECT_THAT(a, Contains(Key(name)));
}

TEST_F(ResenseScene, AnotherRigGivesWhatADirectRunWithItGives) {
  Generated("base", true);
  const Files direct = Direct("other_rig.yaml");
  EXPECT_THAT(direct, AllOf(Contains(Key("excavator1/lidar2/data.csv")),
                            Contains(Key("excavator1/camera/depth/0.png")),
                            Contains(Key("excavator1/camera/normal/0.png")),
                            Contains(Key("excavator1/incline/data.csv")),
                            Contains(Key("mast1/imu/data.csv")),
                            Contains(Key("truth/excavator1/pose.csv"))));
  ExpectSame(direct, Resensed(Other()));
}

TEST_F(ResenseScene, TheSameRigGivesTheSameDatasetAgain) {
  Files base = Generated("base", true);
  EXPECT_EQ(base.erase(kStateFile), 1u);
  EXPECT_THAT(base.at("truth/events.csv"), HasSubstr("person_near,excavator1,,person1,"));
  ExpectSame(base, Resensed({.file = path() / "excavator_rig.yaml", .machine = "excavator1"}));
}

TEST_F(ResenseScene, ADatasetWithoutEventsGetsNone) {
  Generated("base", true);
  fs::remove(path() / "base/truth/events.csv");
  std::string text = ReadWholeFile(path() / "base/dataset.yaml");
  const std::string line = "  - {path: \"truth/events.csv\", type: events}\n";
  ASSERT_THAT(text, HasSubstr(line));
  WriteWholeFile(path() / "base/dataset.yaml", text.erase(text.find(line), line.size()));
  EXPECT_FALSE(Resensed(Other()).contains("truth/events.csv"));
}

TEST_F(ResenseScene, AnotherMachineCarriesTheRigWhereItIsNamed) {
  WriteWholeFile(path() / "tower.yaml", R"(sensors:
  - {name: camera, preset: tera:config/sensors/rgb_640.yaml, link: mast, xyz_m: [0, 0, 4.2], rpy_deg: [0, 22, 0],
     width_px: 64, height_px: 48, rate_hz: 4}
  - {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: mast, xyz_m: [0, 0, 4.4], columns: 90}
)");
  Generated("base", true);
  ExpectSame(Direct("tower.yaml", "machines[1]"),
             Resensed({.file = path() / "tower.yaml", .machine = "mast1"}));
}

TEST_F(ResenseScene, KeepingTheStateChangesNoOtherFile) {
  Files with = Generated("with", true);
  const Files without = Generated("without", false);
  EXPECT_EQ(with.erase(kStateFile), 1u);
  ExpectSame(without, with);
}

TEST_F(ResenseScene, ARunThatWasInterruptedIsFinishedWithTheSameBytes) {
  struct Killed {};
  Generated("base", true);
  const Files whole = Resensed(Other(), "whole");
  GenerateOptions options{.out = path() / "killed", .threads = 1};
  options.progress = [](const GenerateProgress& progress) {
    if (progress.simulated_s > 0.35) throw Killed();
  };
  EXPECT_THROW(Resense(path() / "base", Other(), {}, options), Killed);
  EXPECT_FALSE(fs::exists(path() / "killed"));
  ASSERT_TRUE(fs::exists(path() / "killed.incomplete"));
  options.progress = nullptr;
  options.resume = true;
  Resense(path() / "base", Other(), {}, options);
  ExpectSame(whole, AllFiles(path() / "killed"));
  EXPECT_FALSE(fs::exists(path() / "killed.incomplete"));
}

TEST_F(ResenseScene, ARunThatWasInterruptedIsNotFinishedWithAnotherRig) {
  struct Killed {};
  Generated("base", true);
  GenerateOptions options{.out = path() / "killed", .threads = 1};
  options.progress = [](const GenerateProgress&) { throw Killed(); };
  EXPECT_THROW(Resense(path() / "base", Other(), {}, options), Killed);
  const auto before = AllFiles(path() / "killed.incomplete");
  options.progress = nullptr;
  options.resume = true;
  const ResenseRig another{.file = path() / "excavator_rig.yaml", .machine = ""};
  EXPECT_THROW(Resense(path() / "base", another, {}, options), InputError);
  EXPECT_TRUE(AllFiles(path() / "killed.incomplete") == before);
}

TEST_F(ResenseScene, AKeptStateOfARunThatWasInterruptedIsTheSameToo) {
  struct Killed {};
  const Files whole = Generated("whole", true);
  const LoadedScenario loaded = LoadScenario(path() / "scene.yaml", {});
  GenerateOptions options{.out = path() / "killed", .threads = 1, .keep_state = true};
  options.progress = [](const GenerateProgress& progress) {
    if (progress.simulated_s > 0.35) throw Killed();
  };
  EXPECT_THROW(Generate(loaded.scenario, loaded.resolved_yaml, options), Killed);
  options.progress = nullptr;
  options.resume = true;
  Generate(loaded.scenario, loaded.resolved_yaml, options);
  ExpectSame(whole, AllFiles(path() / "killed"));
}

TEST_F(ResenseScene, ADatasetThatWasMovedIsMeasuredLikewise) {
  Generated("base", true);
  const Files direct = Direct("other_rig.yaml");
  fs::create_directories(path() / "elsewhere");
  fs::rename(path() / "base", path() / "elsewhere/base");
  Resense(path() / "elsewhere/base", Other(), {}, {.out = path() / "resensed", .threads = 1});
  ExpectSame(direct, AllFiles(path() / "resensed"));
}

TEST_F(ResenseScene, WithoutAStateItIsRefused) {
  Generated("base", false);
  ExpectRefused(Other(), AllOf(HasSubstr("base"), HasSubstr("--keep-state")));
}

TEST_F(ResenseScene, ADatasetThatIsNoneIsRefused) {
  ExpectRefused(Other(), HasSubstr("base"));
  fs::create_directories(path() / "base");
  ExpectRefused(Other(), HasSubstr("base"));
}

TEST_F(ResenseScene, AnUnknownMachineIsRefusedWithThoseThatThereAre) {
  Generated("base", true);
  ExpectRefused({.file = path() / "other_rig.yaml", .machine = "excavator9"},
                AllOf(HasSubstr("excavator9"), HasSubstr("excavator1"), HasSubstr("mast1")));
}

TEST_F(ResenseScene, ARigWithAFaultIsRefused) {
  Generated("base", true);
  const auto refuse = [&](const std::string& rig, const testing::Matcher<std::string>& message) {
    WriteWholeFile(path() / "faulty.yaml", rig);
    ExpectRefused({.file = path() / "faulty.yaml", .machine = ""}, message);
  };
  refuse("sensors: [{name: imu, preset: tera:config/sensors/icm_20948.yaml, link: elbow}]",
         AllOf(HasSubstr("faulty.yaml"), HasSubstr("elbow")));
  refuse("sensors: [{name: x, type: sonar}]", AllOf(HasSubstr("faulty.yaml"), HasSubstr("sonar")));
  refuse("sensors: {", HasSubstr("faulty.yaml"));
  refuse("", HasSubstr("faulty.yaml"));
  ExpectRefused({.file = path() / "absent.yaml", .machine = ""}, HasSubstr("absent.yaml"));
  ExpectRefused({.file = path(), .machine = ""}, HasSubstr(path().string()));
}

TEST_F(ResenseScene, AnEffectOfASensorThatTheRigLacksIsRefused) {
  // A direct run with this rig is refused too.
  Generated("base", true);
  WriteWholeFile(path() / "without_imu.yaml",
                 "sensors: [{name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper}]\n");
  EXPECT_THROW(Direct("without_imu.yaml"), InputError);
  ExpectRefused({.file = path() / "without_imu.yaml", .machine = ""}, HasSubstr("imu"));
}

TEST_F(ResenseScene, ADamagedStateIsRefusedAndNothingIsLeft) {
  Generated("base", true);
  const fs::path file = path() / "base" / kStateFile;
  const std::string good = ReadWholeFile(file);
  for (const double share : {0.0, 0.3, 0.999}) {
    std::string bad = good;
    const auto at = static_cast<std::size_t>(share * static_cast<double>(good.size()));
    bad[at] = static_cast<char>(bad[at] ^ 0x5a);
    WriteWholeFile(file, bad);
    ExpectRefused(Other(), HasSubstr("state.blocks"));
    WriteWholeFile(file, std::string_view(good).substr(0, at));
    ExpectRefused(Other(), HasSubstr("state.blocks"));
  }
}

TEST_F(ResenseScene, AStateThatEndsBeforeItsRunIsRefusedAndNothingIsLeft) {
  // A state with one block more than a start: as if the run had taken no step. It shows at the end.
  Generated("base", true);
  const fs::path file = path() / "base" / kStateFile;
  BlockFileReader reader(file);
  std::vector<Block> blocks;
  while (std::optional<Block> block = reader.Next()) blocks.push_back(*block);
  BlockFileWriter writer(file, reader.header());
  for (std::size_t b = 0; b + 1 < blocks.size(); ++b) writer.Append(blocks[b]);
  writer.Commit();
  ExpectRefused(Other(), HasSubstr("state.blocks"));
}

TEST_F(ResenseScene, AStateOfAnotherDatasetIsRefused) {
  Generated("base", true);
  Generated("second", true, {"seed=6"});
  fs::copy_file(path() / "second" / kStateFile, path() / "base" / kStateFile,
                fs::copy_options::overwrite_existing);
  ExpectRefused(Other(), HasSubstr("another scenario"));
}

TEST_F(ResenseScene, WhatIsWrittenInTheDatasetIsNotReadAgain) {
  Generated("base", true);
  const Files direct = Direct("other_rig.yaml");
  for (const std::string file : {"scene.yaml", "mast_rig.yaml", "excavator_rig.yaml"}) {
    fs::remove(path() / file);
  }
  ExpectSame(direct, Resensed(Other()));
}

TEST_F(ResenseScene, AnInputThatHasChangedIsRefused) {
  Generated("base", true);
  WriteWholeFile(path() / "box.obj", std::string(kBox) + "# another text\n");
  ExpectRefused(Other(), HasSubstr("box.obj"));
}

TEST_F(ResenseScene, AFolderThatIsNotEmptyIsRefused) {
  Generated("base", true);
  fs::create_directories(path() / "full");
  WriteWholeFile(path() / "full/mine.txt", "keep me");
  EXPECT_THROW(Resensed(Other(), "full"), InputError);
  EXPECT_EQ(AllFiles(path() / "full"), (Files{{"mine.txt", "keep me"}}));
}

TEST_F(ResenseScene, AMissingTableOfTheTruthIsRefusedAndNothingIsLeft) {
  Generated("base", true);
  fs::remove(path() / "base/truth/excavator1/joints.csv");
  ExpectRefused(Other(), HasSubstr("joints.csv"));
}

}  // namespace
}  // namespace tera
