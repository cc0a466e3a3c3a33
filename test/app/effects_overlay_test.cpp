#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/program.h"
#include "core/config/csv.h"

// --effects: an overlay on a scenario's own effects, and its result.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// The excavator for half a second, its boom lever at 0.5 from 0.1 s on.
std::string Scenario() {
  return R"(
name: lever
seed: 3
duration_s: 0.5
settle_s: 0.3
terrain: {size_m: [12, 12], cell_m: 0.2, soil: dirt}
machines:
  - name: excavator1
    machine: 'tera:config/machines/tb235.yaml'
    operator: {type: lever_replay, csv: levers.csv}
    rig: {sensors: [{name: encoders, preset: 'tera:config/sensors/encoder.yaml', joints: [boom]}]}
effects:
  excavator1: {boom: {dead_band: {width: 0.1}}}
)";
}

/// Columns of the boom in the dataset of a run with `arguments`.
struct BoomRun {
  std::string scenario;
  std::vector<double> boom_rad;
};

BoomRun Generate(const ScratchDirectory& scratch, const std::string& out,
                 const Arguments& arguments) {
  WriteWholeFile(scratch.path() / "scenario.yaml", Scenario());
  WriteWholeFile(scratch.path() / "levers.csv", "t_ns,boom\n0,0\n100000000,0.5\n");
  Arguments all = {"generate", "scenario.yaml", "--out", out};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome outcome = RunTera(all, {scratch.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  BoomRun run;
  const fs::path folder = scratch.path() / out;
  run.scenario = ReadWholeFile(folder / "scenario.yaml");
  run.boom_rad = ReadCsvColumns(folder / "truth/excavator1/joints.csv", {"boom_rad"}).at(0);
  return run;
}

TEST(Effects, OfAFileLieOverTheScenariosAndUnderSet) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "late.yaml",
                 "effects: {excavator1: {boom: {command_delay: {delay_s: 0.2}}}}\n");
  WriteWholeFile(scratch.path() / "later.yaml",
                 "effects: {excavator1: {boom: {command_delay: {delay_s: 0.3}}}}\n");
  const BoomRun plain = Generate(scratch, "plain", {});
  const BoomRun late = Generate(scratch, "late", {"--effects", "late.yaml"});
  EXPECT_NE(late.boom_rad, plain.boom_rad);
  EXPECT_THAT(late.scenario, AllOf(HasSubstr("dead_band"), HasSubstr("delay_s: 0.2")));
  const BoomRun later =
      Generate(scratch, "later", {"--effects", "late.yaml", "--effects", "later.yaml"});
  EXPECT_THAT(later.scenario, HasSubstr("delay_s: 0.3"));
  const BoomRun set =
      Generate(scratch, "set",
               {"--effects", "later.yaml", "--set", "effects.excavator1.boom.command_delay=none"});
  EXPECT_EQ(set.boom_rad, plain.boom_rad);
}

TEST(Effects, OfTheShippedHydraulicMachineSlowItsBoom) {
  const ScratchDirectory scratch;
  const std::string overlay = std::string(TERA_SOURCE_DIR) + "/config/effects/tb235_hydraulic.yaml";
  const BoomRun plain = Generate(scratch, "plain", {});
  const BoomRun hydraulic = Generate(scratch, "hydraulic", {"--effects", overlay});
  const auto raised = [](const BoomRun& run) { return run.boom_rad.back() - run.boom_rad.front(); };
  EXPECT_GT(raised(hydraulic), 0.01);
  EXPECT_LT(raised(hydraulic), 0.8 * raised(plain));
}

TEST(Effects, OfAMachineThatIsNotThereAreRefused) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "scenario.yaml", Scenario());
  WriteWholeFile(scratch.path() / "levers.csv", "t_ns,boom\n0,0\n");
  WriteWholeFile(scratch.path() / "wrong.yaml",
                 "effects: {excavator2: {boom: {command_delay: {delay_s: 0.2}}}}\n");
  for (const char* command : {"check", "generate"}) {
    Arguments arguments = {command, "scenario.yaml", "--effects", "wrong.yaml"};
    if (std::string(command) == "generate") arguments.insert(arguments.end(), {"--out", "run"});
    const Outcome outcome = RunTera(arguments, {scratch.path()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("wrong.yaml:1:11"), HasSubstr("did you mean 'excavator1'")));
  }
  EXPECT_FALSE(fs::exists(scratch.path() / "run"));
}

TEST(Effects, OutOfTheirRangeAreRefusedWithTheirPlace) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "scenario.yaml", Scenario());
  WriteWholeFile(scratch.path() / "levers.csv", "t_ns,boom\n0,0\n");
  WriteWholeFile(scratch.path() / "wrong.yaml",
                 "effects: {excavator1: {boom: {dead_band: {width: 1.5}}}}\n");
  const Outcome outcome =
      RunTera({"check", "scenario.yaml", "--effects", "wrong.yaml"}, {scratch.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("wrong.yaml:1:50"), HasSubstr("1.5 is out of range, need 0 to 0.9")));
}

}  // namespace
}  // namespace tera
