#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "app/program.h"
#include "app/refused.h"
#include "campaign/campaign_files.h"

// `tera sweep` from a user's view.

namespace tera {
namespace {

using testing::HasSubstr;

std::string SweepOf(const std::string& key, const std::string& figure) {
  return "name: starts\nscenario: resting.yaml\nepisodes: 6\nfactors:\n  - {key: '" + key +
         "', levels: [0.5, 1.5, 2.5]}\noutcome:\n  run: compare reference {episode} --json "
         "{out}/compared.json\n  report: compared.json\n  figure: " +
         figure + "\n";
}

class SweepCommand : public testing::Test {
 protected:
  SweepCommand() {
    std::string scenario = kRestingRover;
    scenario.insert(scenario.find("    operator:"), "    start: {xy_m: [0.5, 0], yaw_deg: 0}\n");
    WriteWholeFile(scratch_.path() / "resting.yaml", scenario);
    EXPECT_EQ(RunTera({"generate", "resting.yaml", "--out", "reference"}, {scratch_.path()}).status,
              0);
  }
  void Write(const std::string& sweep) { WriteWholeFile(scratch_.path() / "sweep.yaml", sweep); }
  Outcome Sweep() {
    return RunTera({"sweep", "sweep.yaml", "--out", "swept", "--processes", "2"},
                   {scratch_.path()});
  }
  ScratchDirectory scratch_;
};

TEST_F(SweepCommand, AFactorThatNamesNoKeyIsRefusedBeforeAnyEpisode) {
  Write(SweepOf("machines[0].start.height", "x"));
  const Outcome outcome = Sweep();
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("machines[0].start.height"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "swept/episodes"));
}

TEST_F(SweepCommand, AnOutcomeThatNamesNoFigureCostsOneEpisode) {
  Write(SweepOf("machines[0].start.xy_m[0]", "machines[0].tracks[0].nothing"));
  const Outcome outcome = Sweep();
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("names no figure"));
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "swept/episodes/000000"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "swept/episodes/000001"));
}

// The rover rests at x = 0.5, 1.5 and 2.5 m, the reference at 0.5 m: errors of 0, 1 and 2 m.
TEST_F(SweepCommand, ASlopeIsThatOfTheGeometryAndASweepGoesOnWhereItWas) {
  Write(SweepOf("machines[0].start.xy_m[0]", "machines[0].tracks[0].ape.translation_m.mean"));
  const Outcome outcome = Sweep();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string table = ReadWholeFile(scratch_.path() / "swept/sweep.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);
  const std::string page = ReadWholeFile(scratch_.path() / "swept/sweep.md");
  std::smatch slope;
  ASSERT_TRUE(std::regex_search(page, slope, std::regex(": ([0-9.]+) per unit"))) << page;
  EXPECT_NEAR(std::stod(slope[1]), 1, 0.05);
  for (const char* name : {"runs.csv", "sweep.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "swept" / name)) << name;
  }
  const std::string runs = ReadWholeFile(scratch_.path() / "swept/runs.csv");
  EXPECT_EQ(Sweep().status, 0);
  EXPECT_EQ(ReadWholeFile(scratch_.path() / "swept/runs.csv"), runs);
}

// The first episode is refused: the rover starts at x = 0.5, 1.5 and 2.5 m, the rule needs 1 m.
TEST_F(SweepCommand, AFirstEpisodeThatFailsIsCountedAndTheOthersAreMade) {
  Write(
      SweepOf("machines[0].start.xy_m[0]", "machines[0].tracks[0].ape.translation_m.mean") +
      "accept: [{name: far, table: truth/rover1/pose.csv, column: x_m, of: last, at_least: 1}]\n");
  const Outcome outcome = Sweep();
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "swept/episodes/000000"));
  const std::string runs = ReadWholeFile(scratch_.path() / "swept/runs.csv");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 5);
}

TEST_F(SweepCommand, ACampaignWithoutAnOutcomeIsNoSweep) {
  Write("name: none\nscenario: resting.yaml\nepisodes: 1\n");
  const Outcome outcome = Sweep();
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("outcome"));
}

}  // namespace
}  // namespace tera
