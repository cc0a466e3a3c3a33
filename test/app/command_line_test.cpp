#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/other_program.h"
#include "app/program.h"
#include "core/faults.h"

// The commands other than `generate`, and their common behaviour.

namespace tera {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
namespace fs = std::filesystem;

const char* const kCommands[] = {"generate",   "check",  "info",     "compare",   "import",
                                 "import-rig", "layout", "overview", "replay",    "resense",
                                 "ros2",       "serve",  "manual",   "completion"};

TEST(CommandLine, EveryCommandHasHelp) {
  const ScratchDirectory scratch;
  const Outcome all = RunTera({"--help"}, {scratch.path()});
  EXPECT_EQ(all.status, 0);
  for (const char* command : kCommands) {
    EXPECT_THAT(all.out, HasSubstr(command));
    const Outcome help = RunTera({command, "--help"}, {scratch.path()});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_THAT(help.out, HasSubstr("Usage")) << command;
    EXPECT_EQ(help.err, "") << command;
  }
}

TEST(CommandLine, WrongUseIsStatus2AndPointsToTheHelp) {
  const ScratchDirectory scratch;
  Arguments wrong[] = {{},
                       {"fly"},
                       {"check"},
                       {"check", "a.yaml", "b.yaml"},
                       {"generate", "a.yaml"},
                       {"generate", "a.yaml", "--out", "run", "--seed", "-3"},
                       {"generate", "a.yaml", "--out", "run", "--seed", "x"},
                       {"generate", "a.yaml", "--out", "run", "--duration", "0"},
                       {"generate", "a.yaml", "--out", "run", "--threads", "0"},
                       {"generate", "a.yaml", "--out", "run", "--egl-device", "-1"},
                       {"info", "--egl-device", "-1"}};
  for (const Arguments& arguments : wrong) {
    const Outcome outcome = RunTera(arguments, {scratch.path()});
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("Run with --help for more information."));
  }
  for (const char* command : kCommands) {
    EXPECT_EQ(RunTera({command, "--no-such-option"}, {scratch.path()}).status, 2) << command;
  }
  EXPECT_TRUE(Entries(scratch.path()).empty());
}

TEST(CommandLine, AValueThatIsNoneIsRefusedWithWhatIsNeeded) {
  const ScratchDirectory scratch;
  const auto faults = [&](const Arguments& arguments) {
    const Outcome outcome = RunTera(arguments, {scratch.path()});
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  for (const char* duration : {"-3", "3s", "inf", "0"}) {
    EXPECT_THAT(
        faults({"generate", "a.yaml", "--out", "run", "--duration", duration}),
        StartsWith("--duration: '" + std::string(duration) + "'; need a number > 0, in seconds\n"));
  }
  EXPECT_THAT(faults({"check", "a.yaml", "--seed", "-1"}),
              StartsWith("--seed: '-1'; need a whole number >= 0\n"));
  EXPECT_THAT(faults({"generate", "a.yaml", "--out", "run", "--threads", "2.5"}),
              StartsWith("--threads: '2.5'; need a whole number from 1 to 256\n"));
}

TEST(CommandLine, AMisspeltOptionOrCommandIsNamedWithWhatItResembles) {
  const ScratchDirectory scratch;
  const auto faults = [&](const Arguments& arguments) {
    const Outcome outcome = RunTera(arguments, {scratch.path()});
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  EXPECT_THAT(faults({"generate", "a.yaml", "--output", "run"}),
              StartsWith("--output: no such option of 'generate' (did you mean '--out'?)\n"));
  EXPECT_THAT(faults({"generate", "a.yaml", "--out", "run", "--sed=3"}),
              StartsWith("--sed: no such option of 'generate' (did you mean '--seed'?)\n"));
  EXPECT_THAT(faults({"generat", "a.yaml", "--out", "run"}),
              StartsWith("'generat': no such command (did you mean 'generate'?)\n"));
}

TEST(CommandLine, ProveIsAnotherProgramAndSaysSo) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      RunTera({"prove", "--out", "proof", "--cases", "3", "--seed", "1"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, ContainsRegex("^tera prove: [^\n]*tera-prove[^\n]*\n$"));
  EXPECT_TRUE(Entries(scratch.path()).empty());
  EXPECT_THAT(RunTera({"--help"}, {scratch.path()}).out, Not(HasSubstr("prove")));
  EXPECT_THAT(RunTera({"completion", "bash"}, {scratch.path()}).out, Not(HasSubstr("prove")));
}

TEST(CommandLine, VersionStandsAloneOnTheFirstLineBeforeHowItWasBuilt) {
  const Outcome outcome = RunTera({"--version"}, {fs::temp_directory_path()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("^tera [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  for (const char* line :
       {"\ncompiler +[A-Za-z]+ [0-9.]+\n", "\nbuild +[A-Za-z]+\n",
        "\nlibraries +assimp [0-9.]+, .*EGL 1\\.[0-9], .*Embree 3\\.[0-9.]+, .*OpenCV [0-9.]+"}) {
    EXPECT_THAT(outcome.out, ContainsRegex(line));
  }
}

TEST(CommandLine, VersionNamesTheCommitOfARepository) {
  if (!fs::exists(TERA_SOURCE_DIR "/.git") || !HasProgram("git")) {
    GTEST_SKIP() << "needs git and the sources in a repository of theirs";
  }
  const Outcome outcome = RunTera({"--version"}, {fs::temp_directory_path()});
  EXPECT_THAT(outcome.out, ContainsRegex("\ncommit +[0-9a-f]{12}( and changes)?\n"));
}

TEST(CommandLine, BashCompletesWhatTheProgramTakes) {
  const ScratchDirectory scratch;
  const Outcome script = RunTera({"completion", "bash"}, {scratch.path()});
  ASSERT_EQ(script.status, 0) << script.err;
  WriteWholeFile(scratch.path() / "script", script.out);
  const auto offered = [&](const std::string& words) {
    WriteWholeFile(scratch.path() / "commands",
                   "source ./script\nCOMP_WORDS=(" + words +
                       ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_tera\necho ${COMPREPLY[@]}\n");
    return OutputOf("cd " + scratch.path().string() + " && bash --norc commands")
        .value_or("failed");
  };
  EXPECT_EQ(offered("tera repl"), "replay\n");
  EXPECT_EQ(offered("tera layout ''"), "evaluate compare optimise\n");
  EXPECT_EQ(offered("tera export run --storage ''"), "mcap sqlite3\n");
  EXPECT_EQ(offered("tera generate a.yaml --keep"), "--keep-state\n");
  EXPECT_EQ(offered("tera completion ''"), "bash fish zsh\n");
}

TEST(CommandLine, ManualHasAPageForEveryCommand) {
  const ScratchDirectory scratch;
  ASSERT_EQ(RunTera({"manual", "--out", "man"}, {scratch.path()}).status, 0);
  for (const char* command : kCommands) {
    const std::string page =
        ReadWholeFile(scratch.path() / "man" / (std::string("tera-") + command + ".1"));
    EXPECT_THAT(page, HasSubstr(".SH SYNOPSIS\n\\fBtera ")) << command;
  }
  EXPECT_THAT(ReadWholeFile(scratch.path() / "man/tera-layout-evaluate.1"),
              HasSubstr("\\fB\\-\\-study\\fR \\fITEXT\\fR"));
  const Outcome again = RunTera({"manual", "--out", "man"}, {scratch.path()});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, TellsOf("man"));
}

TEST(Info, NamesVersionsRendererAndThreads) {
  const Outcome outcome = RunTera({"info"}, {fs::temp_directory_path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* line :
       {"tera +[0-9.]+\n", "data +/.*\n", "EGL platform +[a-z]", "GL renderer +[A-Za-z]",
        "GL version +4\\.[56]", "Embree +3\\.[0-9]", "threads +[1-9]"}) {
    EXPECT_THAT(outcome.out, ContainsRegex(line));
  }
}

TEST(Check, SaysWhatOfAUrdfIsNotRead) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml",
                 Edited(Edited(SmallScenario(), "tera:config/machines/warthog.yaml",
                               TERA_SOURCE_DIR "/test/sim/data/backhoe_loader.yaml"),
                        "cell_m: 0.1", "cell_m: 0.2"));
  const Outcome outcome = RunTera({"check", "small.yaml"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("machine rover1 (backhoe_loader): 23 links, 22 joints, 10 levers"),
                    HasSubstr("\n  levers: loader_lift, loader_tilt, swing, boom, dipper, curl, "),
                    HasSubstr("\nbackhoe_loader.urdf: 1 texture, 1 safety controller "
                              "left out\nvalid\n")));
}

TEST(Check, PrintsTheRigAsATable) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario(kLidar));
  const Outcome outcome = RunTera({"check", "small.yaml"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("machine rover1 (warthog): 1 links, 0 joints, 2 levers, 470 kg"),
                    HasSubstr("\n  levers: left_track, right_track\n"),
                    ContainsRegex("sensor +type +link +xyz m +rpy deg +rate Hz\n"),
                    ContainsRegex("imu +imu +chassis +0.000 0.000 0.000 +0.0 0.0 0.0 +100\n"),
                    ContainsRegex("lidar +lidar +chassis +0.000 0.000 1.200 +0.0 0.0 0.0 +10\n"),
                    testing::EndsWith("valid\n")));
  EXPECT_EQ(Entries(scratch.path()), std::set<std::string>{"small.yaml"});
}

TEST(Check, FindsEveryShippedScenarioValid) {
  for (const auto& file : fs::directory_iterator(TERA_SOURCE_DIR "/config/scenarios")) {
    if (file.path().extension() != ".yaml") continue;  // levers that scenarios replay
    const Outcome outcome = RunTera({"check", file.path()}, {fs::temp_directory_path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, AllOf(testing::EndsWith("valid\n"), Not(HasSubstr("warning:"))));
  }
}

TEST(Compare, ADatasetDiffersFromItselfByNothing) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario());
  ASSERT_EQ(RunTera({"generate", "small.yaml", "--out", "run"}, {scratch.path()}).status, 0);
  const Outcome outcome = RunTera({"compare", "run", "run"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const std::string zeros = " +0.000 +0.000 +0.000 +0.000 +0.00 +0.00 +0.00\n";
  EXPECT_THAT(
      outcome.out,
      AllOf(ContainsRegex("APE, not aligned" + zeros), ContainsRegex("SE.2. aligned" + zeros),
            ContainsRegex("SE.3. aligned" + zeros), ContainsRegex("RPE over 1 s"),
            // 0.4 s of poses at 500 Hz, the start included; of the IMU at 100 Hz, the end excluded.
            HasSubstr("201 common times"), ContainsRegex("imu wz_radps +0 +0 +40\n"),
            ContainsRegex("imu az_mps2 +0 +0 +40\n"), Not(HasSubstr("plot"))));
  EXPECT_FALSE(fs::exists(scratch.path() / "compare.png"));
  const Outcome plotted =
      RunTera({"compare", "run", "run", "--plot", "compare.png"}, {scratch.path()});
  EXPECT_THAT(plotted.out, HasSubstr("plot: compare.png\n"));
  EXPECT_EQ(ReadWholeFile(scratch.path() / "compare.png").substr(1, 3), "PNG");
}

TEST(Compare, APlotThatCannotBeWrittenIsRefusedAndNoPartOfItLeft) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "small.yaml", SmallScenario());
  ASSERT_EQ(RunTera({"generate", "small.yaml", "--out", "run"}, {scratch.path()}).status, 0);
  const auto before = Entries(scratch.path());
  const Outcome outcome =
      RunTera({"compare", "run", "run", "--plot", "no/folder.png"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err,
            "no/folder.png: cannot be created: No such file or directory; choose a path with "
            "folders as parents\n");
  EXPECT_EQ(Entries(scratch.path()), before);
}

TEST(Overview, DrawsADatasetInItsOwnFolder) {
  const ScratchDirectory scratch;
  WriteWholeSample(scratch.path() / "run", {});
  const Outcome outcome = RunTera({"overview", "run"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "run/overview.png\nrun/overview.mp4\n");
  EXPECT_EQ(ReadWholeFile(scratch.path() / "run/overview.png").substr(1, 3), "PNG");
  EXPECT_EQ(ReadWholeFile(scratch.path() / "run/overview.mp4").substr(4, 4), "ftyp");
}

// The paper's own rig, including its misspelt place.
constexpr const char* kPaperRig = R"(Excavator:
  - id: digger
    type: TB235
    sensors:
      - {id: 1, type: IMU, topic: /excavator1/imu_chassis, location: CHASIS, noise: [0.01, 0.05],
         offset: [0.3436, 0.15, -0.2921], rotation: [0, -90, 90]}
      - {id: 2, type: LIDAR, topic: /excavator1/lidar, location: CHASSIS, noise: [0, 0.02],
         offset: [0, 0.745, -1.125]}
  - id: helper
    sensors: [{id: 1, type: GPS, topic: /excavator2/gps, location: CHASSIS, noise: [0, 0.75]}]
)";

TEST(ImportRig, TurnsThePapersFormIntoARigThatAScenarioTakes) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "paper.yaml", kPaperRig);
  const Outcome imported = RunTera(
      {"import-rig", "paper.yaml", "--machine", "digger", "--out", "rig.yaml"}, {scratch.path()});
  EXPECT_EQ(imported.status, 0) << imported.err;
  EXPECT_EQ(imported.out, "");
  const std::string scenario = SmallScenario();
  const std::size_t rig = scenario.find("rig: ");
  WriteWholeFile(scratch.path() / "small.yaml",
                 Edited(scenario.substr(0, rig), "warthog", "tb235") + "rig: rig.yaml\n");
  const Outcome checked = RunTera({"check", "small.yaml"}, {scratch.path()});
  EXPECT_EQ(checked.status, 0) << checked.err;
  // Unity's right, up, forward are TERA's -y, z, x.
  EXPECT_THAT(checked.out, AllOf(ContainsRegex("imu_chassis +imu +upper +-0.292 -0.344 0.150 "),
                                 ContainsRegex("lidar +lidar +upper +-1.125 -?0.000 0.745 ")));
}

TEST(ImportRig, PrintsWhereNoFileIsGivenAndKnowsItsMachines) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "paper.yaml", kPaperRig);
  const Outcome helper =
      RunTera({"import-rig", "paper.yaml", "--machine", "helper"}, {scratch.path()});
  EXPECT_EQ(helper.status, 0) << helper.err;
  EXPECT_THAT(helper.out, AllOf(HasSubstr("name: gps"), Not(HasSubstr("imu_chassis"))));
  const Outcome other =
      RunTera({"import-rig", "paper.yaml", "--machine", "digga"}, {scratch.path()});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("no machine 'digga'; need one of digger, helper"));
  EXPECT_EQ(Entries(scratch.path()), std::set<std::string>{"paper.yaml"});
}

TEST(ImportRig, SeveralMachinesAreThoseOfAScenario) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "paper.yaml", kPaperRig);
  const Outcome imported = RunTera({"import-rig", "paper.yaml"}, {scratch.path()});
  EXPECT_EQ(imported.status, 0) << imported.err;
  const std::string scenario = SmallScenario();
  WriteWholeFile(scratch.path() / "two.yaml",
                 scenario.substr(0, scenario.find("machines:")) + imported.out);
  const Outcome checked = RunTera({"check", "two.yaml"}, {scratch.path()});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, AllOf(HasSubstr("machine digger (tb235)"),
                                 HasSubstr("machine helper (tb235)"), HasSubstr("\n  gps ")));
}

}  // namespace
}  // namespace tera
