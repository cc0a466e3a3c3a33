#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>

#include "app/program.h"
#include "core/faults.h"

// A run of `tera generate` from its start to its end, or to its refusal.

namespace tera {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
namespace fs = std::filesystem;

/// A run long enough to be stopped, with frames of a camera and a lidar.
std::string LongScenario() {
  return Edited(SmallScenario(std::string(kCamera) + ", " + kLidar), "duration_s: 0.4",
                "duration_s: 1");
}

class GenerateRun : public testing::Test {
 protected:
  GenerateRun() { WriteWholeFile(path() / "long.yaml", LongScenario()); }

  const fs::path& path() const { return scratch_.path(); }

  static Arguments Generate(const std::string& out, const Arguments& more = {}) {
    Arguments arguments = {"generate", "long.yaml", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  std::map<std::string, std::string> Whole() {
    const Outcome outcome = RunTera(Generate("whole"), {path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return AllFiles(path() / "whole");
  }

  /// Stops a run by `signal` when its first pictures are on the disk, and returns how it ended.
  Outcome Stopped(const std::string& out, int signal) {
    TeraProcess run(Generate(out), {path()});
    const fs::path pictures = path() / (out + ".incomplete/rover1/camera/rgb");
    const auto count = [&] {
      std::error_code absent;
      return std::distance(fs::directory_iterator(pictures, absent), fs::directory_iterator());
    };
    while (count() < 3 && run.Running()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_TRUE(run.Running()) << "ended before it could be stopped";
    run.Signal(signal);
    return run.Wait();
  }

 private:
  ScratchDirectory scratch_;
};

TEST_F(GenerateRun, SaysAtItsEndWhatItCostButNoProgressWhereThereIsNoTerminal) {
  const Outcome outcome = RunTera(Generate("run", {"--duration", "0.2"}), {path()});
  EXPECT_EQ(outcome.status, 0);
  const std::string number = " +[0-9.]+ +([0-9.]+ x|-)\n";
  EXPECT_THAT(outcome.out,
              MatchesRegex("run: 0\\.2 s simulated in [0-9.]+ s, [0-9]+ frames, [0-9.]+ MB\n"
                           "  stage +wall s +real time\n"
                           "  physics" +
                           number + "  soil" + number + "  cameras" + number + "  lidars" + number +
                           "  everything else" + number + "  whole run" + number));
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(fs::exists(path() / "run/dataset.yaml"));
  EXPECT_FALSE(fs::exists(path() / "run.incomplete"));
}

/// The successive lines of one row of a terminal.
std::vector<std::string> ProgressLines(const std::string& terminal) {
  std::vector<std::string> lines;
  std::stringstream stream(terminal.substr(0, terminal.find("\r\n")));
  for (std::string line; std::getline(stream, line, '\r');) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

TEST_F(GenerateRun, ShowsOnATerminalHowFarItIsAndHowFast) {
  const Outcome outcome = RunTeraOnTerminal(Generate("run"), path(), 80);
  EXPECT_EQ(outcome.status, 0);
  const auto lines = ProgressLines(outcome.out);
  ASSERT_GE(lines.size(), 5u);  // every fifth of a second
  for (const std::string& line : lines) {
    EXPECT_THAT(line, ContainsRegex("^\\[[#.]+\\] [0-9]+\\.[0-9] / 1\\.0 s  [0-9]+\\.[0-9][0-9] x "
                                    "real time  [0-9]+ frames  [0-9]+:[0-9][0-9] left"));
    // A line of 80 would wrap, and the next \r would not reach its beginning. ESC [ K takes 3.
    EXPECT_LE(line.size(), 79u + 3u);
  }
  EXPECT_THAT(lines.front(), HasSubstr("0.2 / 1.0 s"));
  EXPECT_THAT(lines.back(), HasSubstr("1.0 / 1.0 s"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1.0 s simulated in"), HasSubstr("physics")));
}

TEST_F(GenerateRun, FitsItsProgressIntoANarrowTerminal) {
  for (const int columns : {50, 20}) {
    const std::string out = "run" + std::to_string(columns);
    const Outcome outcome =
        RunTeraOnTerminal(Generate(out, {"--duration", "0.4"}), path(), columns);
    EXPECT_EQ(outcome.status, 0);
    for (const std::string& line : ProgressLines(outcome.out)) {
      EXPECT_LE(line.size(), columns - 1u + 3u) << line;
    }
  }
}

TEST_F(GenerateRun, KilledInTheMiddleItIsFinishedWithTheSameBytes) {
  const Outcome killed = Stopped("run", SIGKILL);
  EXPECT_EQ(killed.signal, SIGKILL);
  EXPECT_FALSE(fs::exists(path() / "run"));
  EXPECT_THAT(ReadWholeFile(path() / "run.incomplete/INCOMPLETE.txt"), HasSubstr("--resume"));

  const Outcome again = RunTera(Generate("run"), {path()});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, TellsOf("run.incomplete"));

  const Outcome resumed = RunTera(Generate("run", {"--resume"}), {path()});
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_FALSE(fs::exists(path() / "run.incomplete"));
  EXPECT_TRUE(AllFiles(path() / "run") == Whole());
}

TEST_F(GenerateRun, StoppedByCtrlCItSaysHowToGoOn) {
  const Outcome stopped = Stopped("run", SIGINT);
  EXPECT_EQ(stopped.signal, SIGINT) << "a shell's loop must see that it was Ctrl-C";
  EXPECT_EQ(stopped.err, "\nstopped; the same command with --resume finishes run\n");
  EXPECT_FALSE(fs::exists(path() / "run"));
  const Outcome resumed = RunTera(Generate("run", {"--resume"}), {path()});
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_TRUE(AllFiles(path() / "run") == Whole());
}

TEST_F(GenerateRun, IsNotResumedWithAnotherSeed) {
  Stopped("run", SIGKILL);
  const auto before = Entries(path());
  const Outcome resumed = RunTera(Generate("run", {"--resume", "--seed", "6"}), {path()});
  EXPECT_EQ(resumed.status, 2);
  EXPECT_THAT(resumed.err, HasSubstr("has another scenario, seed, version"));
  EXPECT_EQ(Entries(path()), before);
}

TEST_F(GenerateRun, TakesSeedDurationAndKeysFromTheCommandLine) {
  const Outcome outcome =
      RunTera(Generate("run", {"--seed", "9", "--duration", "0.2", "--threads", "1", "--set",
                               "machines[0].rig.sensors[0].rate_hz=50"}),
              {path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(ReadWholeFile(path() / "run/scenario.yaml"),
              AllOf(HasSubstr("seed: 9"), HasSubstr("duration_s: 0.2"), HasSubstr("rate_hz: 50")));
  const std::string imu = ReadWholeFile(path() / "run/rover1/imu/data.csv");
  // A header and the samples due at 0, 0.02, ... before the end at 0.2 s.
  EXPECT_EQ(std::count(imu.begin(), imu.end(), '\n'), 11);
}

TEST_F(GenerateRun, FindsWhatAScenarioNamesFromAnyWorkingDirectory) {
  fs::create_directories(path() / "site/presets");
  fs::create_directories(path() / "elsewhere");
  WriteWholeFile(path() / "site/presets/slow.yaml", "type: imu\nrate_hz: 20\n");
  WriteWholeFile(path() / "site/small.yaml",
                 Edited(SmallScenario("{name: slow, preset: presets/slow.yaml, link: chassis}"),
                        "duration_s: 0.4", "duration_s: 0.2"));
  const Outcome there = RunTera({"generate", "small.yaml", "--out", "../there"}, {path() / "site"});
  EXPECT_EQ(there.status, 0) << there.err;
  const Outcome elsewhere =
      RunTera({"generate", "../site/small.yaml", "--out", "out"}, {path() / "elsewhere"});
  EXPECT_EQ(elsewhere.status, 0) << elsewhere.err;
  EXPECT_TRUE(AllFiles(path() / "there") == AllFiles(path() / "elsewhere/out"));

  // The same holds for the scenario in the dataset, without the first one's files.
  fs::remove_all(path() / "site");
  const Outcome again =
      RunTera({"generate", "../there/scenario.yaml", "--out", "again"}, {path() / "elsewhere"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(AllFiles(path() / "there") == AllFiles(path() / "elsewhere/again"));
}

TEST_F(GenerateRun, IsReplayedFromItsCommandsToTheSameBytes) {
  const auto whole = Whole();
  const Outcome outcome = RunTera({"replay", "whole", "--out", "again"}, {path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(AllFiles(path() / "again"), whole);
}

TEST_F(GenerateRun, IsNotReplayedIntoItself) {
  const auto whole = Whole();
  const Outcome outcome = RunTera({"replay", "whole", "--out", "whole/again"}, {path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, TellsOf("--out whole/again"));
  EXPECT_EQ(AllFiles(path() / "whole"), whole);
}

TEST_F(GenerateRun, OfOtherLeversThanItsCommandsIsNotReplayed) {
  Whole();
  const fs::path commands = path() / "whole/rover1/commands.csv";
  const std::string text = ReadWholeFile(commands);
  WriteWholeFile(commands, Edited(text, "left_track", "port_track"));
  const Outcome outcome = RunTera({"replay", "whole", "--out", "again"}, {path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the columns are not the levers of machine 'rover1'"));
  EXPECT_FALSE(fs::exists(path() / "again"));
}

}  // namespace
}  // namespace tera
