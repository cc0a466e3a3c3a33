#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/refused.h"
#include "core/faults.h"

// `tera resense` from a user's view: a dataset with its state, measured with another rig.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

constexpr char kResenseCommandRig[] = R"(sensors:
  - {name: imu, preset: tera:config/sensors/icm_20948.yaml, link: chassis, xyz_m: [0.2, 0, 0.4]}
  - {name: gnss, preset: tera:config/sensors/rtk_f9p.yaml, link: chassis, xyz_m: [0, 0, 1]}
)";
constexpr char kState[] = "base/truth/state.blocks";

class ResenseCommand : public testing::Test {
 protected:
  ResenseCommand() {
    WriteWholeFile(path() / "small.yaml", SmallScenario());
    WriteWholeFile(path() / "rig.yaml", kResenseCommandRig);
  }

  const fs::path& path() const { return scratch_.path(); }

  void Succeed(const Arguments& arguments) {
    const Outcome outcome = RunTera(arguments, {path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
  void KeepState() { Succeed({"generate", "small.yaml", "--out", "base", "--keep-state"}); }
  static Arguments Resense(const std::string& out, const std::string& rig = "rig.yaml",
                           const Arguments& more = {}) {
    Arguments arguments = {"resense", "base", rig, "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  const ScratchDirectory scratch_;
};

TEST_F(ResenseCommand, WritesWhatGenerateWithThatRigWrites) {
  KeepState();
  Succeed({"generate", "small.yaml", "--out", "direct", "--set", "machines[0].rig=rig.yaml"});
  Succeed(Resense("other"));
  Succeed(Resense("named", "rig.yaml", {"--machine", "rover1", "--threads", "1"}));
  const auto direct = AllFiles(path() / "direct");
  EXPECT_TRUE(direct.contains("rover1/gnss/data.csv"));
  EXPECT_TRUE(AllFiles(path() / "other") == direct);
  EXPECT_TRUE(AllFiles(path() / "named") == direct);
}

TEST_F(ResenseCommand, KeepingTheStateChangesNoOtherFile) {
  KeepState();
  Succeed({"generate", "small.yaml", "--out", "without"});
  auto base = AllFiles(path() / "base");
  EXPECT_EQ(base.erase("truth/state.blocks"), 1u);
  EXPECT_TRUE(base == AllFiles(path() / "without"));
}

TEST_F(ResenseCommand, SaysAtItsEndWhatItCost) {
  KeepState();
  const Outcome outcome = RunTera(Resense("other"), {path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(StartsWith("other: 0.4 s "), HasSubstr("whole run")));
  EXPECT_FALSE(fs::exists(path() / "other.incomplete"));
}

TEST_F(ResenseCommand, WrongUseIsStatus2AndPointsToTheHelp) {
  const Arguments wrong[] = {{"resense"},
                             {"resense", "base"},
                             {"resense", "base", "rig.yaml"},
                             {"resense", "base", "rig.yaml", "more.yaml", "--out", "other"},
                             {"resense", "base", "rig.yaml", "--out", "other", "--threads", "0"},
                             {"resense", "base", "rig.yaml", "--out", "other", "--seed", "3"}};
  for (const Arguments& arguments : wrong) {
    const Outcome outcome = RunTera(arguments, {path()});
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.err, HasSubstr("Run with --help for more information."));
  }
}

TEST_F(ResenseCommand, ADatasetWithoutStateIsRefusedWithWhatToDo) {
  Succeed({"generate", "small.yaml", "--out", "base"});
  ExpectRefused(scratch_, Resense("other"), AllOf(HasSubstr("base"), HasSubstr("--keep-state")));
}

TEST_F(ResenseCommand, WhatIsNoDatasetIsRefused) {
  ExpectRefused(scratch_, Resense("other"), HasSubstr("base"));
  fs::create_directories(path() / "base");
  ExpectRefused(scratch_, Resense("other"), HasSubstr("base"));
}

TEST_F(ResenseCommand, ADamagedStateIsRefusedByItsName) {
  KeepState();
  const std::string good = ReadWholeFile(path() / kState);
  const auto refuse = [&](const std::string& bytes) {
    WriteWholeFile(path() / kState, bytes);
    ExpectRefused(scratch_, Resense("other"), HasSubstr(kState));
  };
  refuse("");
  refuse("no blocks at all");
  refuse(good.substr(0, good.size() / 2));
  refuse(good + "more");
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 0xff);
  refuse(flipped);
}

TEST_F(ResenseCommand, AnUnknownMachineIsRefusedWithThoseThatThereAre) {
  KeepState();
  ExpectRefused(scratch_, Resense("other", "rig.yaml", {"--machine", "rover2"}),
                AllOf(TellsOf("--machine rover2"), HasSubstr("rover1")));
}

TEST_F(ResenseCommand, ARigWithAFaultIsRefusedWithItsPlace) {
  KeepState();
  const std::string rig =
      Edited(kResenseCommandRig, "icm_20948.yaml, link: chassis", "icm_20948.yaml, link: roof");
  WriteWholeFile(path() / "faulty.yaml", rig);
  ExpectRefused(scratch_, Resense("other", "faulty.yaml"),
                AllOf(TellsOf("faulty.yaml:" + LineAndColumn(rig, "roof")), HasSubstr("chassis")));
  ExpectRefused(scratch_, Resense("other", "absent.yaml"), HasSubstr("absent.yaml"));
}

TEST_F(ResenseCommand, AnOutputAtOrInsideTheDatasetIsRefused) {
  KeepState();
  for (const std::string out : {"base", "base/other", "base/../base", "base/truth/deep/er"}) {
    ExpectRefused(scratch_, Resense(out), TellsOf("--out " + out));
  }
}

TEST_F(ResenseCommand, AnOutputThatIsThereIsRefused) {
  KeepState();
  fs::create_directories(path() / "full");
  WriteWholeFile(path() / "full/mine.txt", "keep me");
  ExpectRefused(scratch_, Resense("full"), HasSubstr("full"));
}

TEST_F(ResenseCommand, AMovedInputIsFoundWhereItIsSaidToBe) {
  fs::copy_file(TERA_SOURCE_DIR "/assets/rock.glb", path() / "stone.glb");
  WriteWholeFile(
      path() / "small.yaml",
      SmallScenario() + "obstacles: [{name: rock1, label: rock, mesh: stone.glb, xy_m: [3, 1]}]\n");
  KeepState();
  fs::create_directories(path() / "elsewhere");
  fs::rename(path() / "stone.glb", path() / "elsewhere/stone.glb");
  ExpectRefused(scratch_, Resense("other"), HasSubstr("stone.glb"));
  Succeed(Resense("other", "rig.yaml",
                  {"--moved", (path() / "stone.glb").string() + "=" +
                                  (path() / "elsewhere/stone.glb").string()}));
  EXPECT_TRUE(fs::exists(path() / "other/rover1/gnss/data.csv"));
}

}  // namespace
}  // namespace tera
