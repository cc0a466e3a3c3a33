#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/faults.h"
#include "own_folder.h"
#include "sim/scenario/scenario.h"

// A single mistake gives a single message, without consequential faults.

namespace tera {
namespace {

using enum FaultKind;

namespace fs = std::filesystem;
using testing::AllOf;

std::string TextOf(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void Replace(const std::string& passage, const std::string& by, std::string* text) {
  const std::size_t at = text->find(passage);
  ASSERT_NE(at, std::string::npos) << passage;
  text->replace(at, passage.size(), by);
}

/// All messages about a scenario with `machine` as its machine, and an operator and sensors that
/// refer to its levers, joints and links.
std::vector<InputFault> FaultsOf(const std::string& machine,
                                 const std::string& levers = "t_s,boom\n0,0.1\n",
                                 const std::vector<std::string>& overrides = {}) {
  const fs::path file = OwnFolder() / "machine.yaml", csv = OwnFolder() / "levers.csv";
  std::ofstream(file) << machine;
  std::ofstream(csv) << levers;
  const Config config = Config::FromText(R"(
name: test
duration_s: 1
terrain: {size_m: [12, 12], cell_m: 0.2, soil: dirt}
effects: {digger: {arm: {dead_band: {width: 0.1}}}}
machines:
  - name: digger
    machine: )" + file.string() + R"(
    start: {joints_deg: {boom: 40}}
    operator: {type: lever_replay, csv: )" + csv.string() +
                                             R"(, time_column: t_s}
    rig: {sensors: [{name: imu, preset: 'tera:config/sensors/xsens_mti_670.yaml', link: boom}]}
)",
                                         "s.yaml", overrides);
  return FaultsIn([&] {
    ReadScenario(config.root());
    config.Finish();
  });
}

/// The compact excavator with one passage of its file replaced.
std::string Digger(const std::string& passage = "", const std::string& by = "") {
  std::string text = TextOf(DataRoot() / "config/machines/tb235.yaml");
  for (std::size_t at = 0; (at = text.find("../../", at)) != std::string::npos;) {
    text.replace(at, 6, "tera:");
  }
  Replace(passage, by, &text);
  return text;
}

FaultsMatcher OneLine(const FaultsMatcher& fault) { return AllOf(fault, testing::SizeIs(1)); }

TEST(OneFault, TheScenarioItselfHasNone) { EXPECT_THAT(FaultsOf(Digger()), testing::IsEmpty()); }

TEST(OneFault, AMachineFileThatIsNoYaml) {
  EXPECT_THAT(FaultsOf(Digger("gauge_m: 1.148", "gauge_m: 1.148: 3")),
              OneLine(HasFault(kMalformed)));
}

TEST(OneFault, AMachineFileThatIsNotThere) {
  const Config config = Config::FromText(R"(
name: test
duration_s: 1
terrain: {size_m: [12, 12], cell_m: 0.2, soil: dirt}
machines:
  - {name: digger, machine: nowhere.yaml, start: {joints_deg: {boom: 40}}, operator: {type: idle}}
)",
                                         "s.yaml");
  ReadScenario(config.root());
  try {
    config.Finish();
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.faults(), OneLine(HasFault(kUnreadable)));
  }
}

TEST(OneFault, AMistypedLinkOfAJoint) {
  EXPECT_THAT(FaultsOf(Digger("    child: boom\n", "    child: bom\n")),
              OneLine(HasFault(kNoSuchName, "boom.child")));
}

TEST(OneFault, AMistypedLinkOfACylinderOrALinkage) {
  EXPECT_THAT(
      FaultsOf(Digger("barrel: {link: upper, pin_m: [-0.10", "barrel: {link: uper, pin_m: [-0.10")),
      OneLine(HasFault(kNoSuchName, "swing_cylinder.barrel.link")));
  EXPECT_THAT(FaultsOf(Digger("rod: {link: blade,", "rod: {link: balde,")),
              OneLine(HasFault(kNoSuchName, "blade_cylinder.rod.link")));
  EXPECT_THAT(FaultsOf(Digger("rocker: {link: arm,", "rocker: {link: arn,")),
              OneLine(HasFault(kNoSuchName, "bucket_linkage.rocker.link")));
  EXPECT_THAT(FaultsOf(Digger("rod: {linkage: bucket_linkage,", "rod: {linkage: bucket_linkag,")),
              OneLine(HasFault(kNoSuchName, "rod.linkage")));
}

TEST(OneFault, AMistypedOrMissingTypeOfAJoint) {
  EXPECT_THAT(FaultsOf(Digger("type: revolute", "type: revolut")),
              OneLine(HasFault(kNoSuchName, "type")));
  EXPECT_THAT(FaultsOf(Digger("type: revolute", "typ: revolute")),
              OneLine(HasFault(kMissing, "type")));
}

TEST(OneFault, BesideAMistypedTypeOtherMistakesAreTold) {
  std::string machine = Digger("type: revolute", "type: revolut");
  Replace("    child: boom\n", "    child: bom\n", &machine);
  const auto faults = FaultsOf(machine);
  EXPECT_THAT(faults, HasFault(kNoSuchName));
  EXPECT_THAT(faults, testing::SizeIs(2));
}

TEST(OneFault, AMistypedTypeOfAnOperatorOrASensor) {
  EXPECT_THAT(FaultsOf(Digger(), "t_s,boom\n0,0.1\n", {"machines[0].operator.type=lever_repaly"}),
              OneLine(HasFault(kNoSuchName, "operator.type")));
  EXPECT_THAT(FaultsOf(Digger(), "t_s,boom\n0,0.1\n",
                       {"machines[0].rig.sensors[0].type=camra",
                        "effects.digger.imu={extrinsic: {x_m: 0.1}}"}),
              OneLine(HasFault(kNoSuchName, "sensors[0].type")));
  EXPECT_THAT(FaultsOf(Digger(), "t_s,boom\n0,0.1\n",
                       {"machines[0].rig.sensors={0: {type: camra, link: nowhere}}"}),
              OneLine(HasFault(kNoSuchName, "sensors[0].type")));
}

TEST(OneFault, AJointWhoseChildIsLeftEmpty) {
  EXPECT_THAT(FaultsOf(Digger("    child: boom\n", "    child:\n")),
              OneLine(HasFault(kMistyped, "boom.child")));
}

TEST(OneFault, AMistypedRateIsToldBeforeWhatItLeadsTo) {
  const auto faults =
      FaultsOf(Digger("max_rate_degps: [25.8, 30.8]", "max_rate_radps: [0.45, 0.54]"));
  ASSERT_FALSE(faults.empty());
  EXPECT_THAT(faults.front(), IsFault(kUnknown, "boom.max_rate_radps"));
}

TEST(OneFault, ACsvWithoutItsTimeColumn) {
  EXPECT_THAT(FaultsOf(Digger(), "t,boom\n0,0.1\n"), OneLine(HasFault(kMissing)));
}

TEST(OneFault, AUrdfThatCannotBeReadUnderKeysThatStandOnIt) {
  const std::string on_it = R"(
kind: arm
fixed_base: true
actuators: {motor: {max_effort_nm: 4}}
joints: {boom: {max_rate_degps: 10}}
levers: [boom]
cylinders:
  lift: {barrel: {link: base, pin_m: [0, 0, 0]}, rod: {link: boom, pin_m: [1, 0, 0]}}
effects: {boom: {dead_band: {width: 0.1}}}
urdf: )";
  EXPECT_THAT(FaultsOf(on_it + "gone.urdf\n"), OneLine(HasFault(kUnreadable)));
  const fs::path broken = OwnFolder() / "broken.urdf";
  std::ofstream(broken) << "<robot name=\"r\">\n<link name=\"a\">\n</robot>\n";
  EXPECT_THAT(FaultsOf(on_it + broken.string() + "\n"), OneLine(HasFault(kMalformed, "urdf")));
}

}  // namespace
}  // namespace tera
