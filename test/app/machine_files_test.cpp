#include "app/refused.h"
#include "core/faults.h"

// Foreign machine files: accepted, doubted and refused.

namespace tera {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kMachineScenario = R"(name: t
duration_s: 0.2
settle_s: 1.5
terrain: {size_m: [10, 10], cell_m: 0.2, soil: asphalt}
machines:
  - {name: m1, machine: m.yaml, start: {xy_m: [1, 0.5], yaw_deg: 20}, operator: {type: idle}}
)";

/// A base with an upper structure of that mass, both with the moments of a body of their size.
std::string Robot(const std::string& upper_mass, const std::string& upper_geometry,
                  const std::string& more = "") {
  return R"(<?xml version="1.0"?>
<robot name="m" xmlns:xacro="http://ros.org/wiki/xacro">
  <link name="base_link">
    <inertial><origin xyz="0 0 0.4"/><mass value="1500"/>
      <inertia ixx="400" ixy="0" ixz="0" iyy="600" iyz="0" izz="700"/></inertial>
    <visual><origin xyz="0 0 0.4"/><geometry><box size="2 1.5 0.6"/></geometry></visual>
    <collision><origin xyz="0 0 0.4"/><geometry><box size="2 1.5 0.6"/></geometry></collision>
  </link>
  <link name="upper">
    <inertial><mass value=")" +
         upper_mass + R"("/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry>)" +
         upper_geometry + R"(</geometry></visual>
  </link>
  <joint name="slew" type="continuous"><parent link="base_link"/><child link="upper"/>
    <origin xyz="0 0 0.8"/><axis xyz="0 0 1"/><limit effort="5000" velocity="0.5"/></joint>
)" + more +
         "</robot>\n";
}

const std::string kPlain = Robot("500", R"(<box size="1 1 0.5"/>)");

class MachineFiles : public testing::Test {
 protected:
  void Write(const std::string& robot, const std::string& keys = "") {
    WriteWholeFile(scratch.path() / "s.yaml", kMachineScenario);
    WriteWholeFile(scratch.path() / "m.yaml", "kind: m\nurdf: m.urdf\n" + keys);
    WriteWholeFile(scratch.path() / "m.urdf", robot);
  }
  Outcome Check(const Arguments& more = {}) const {
    Arguments arguments = {"check", "s.yaml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunTera(arguments, {scratch.path()});
  }

  const ScratchDirectory scratch;
};

constexpr const char* kFixed = "fixed_base: true\n";

TEST_F(MachineFiles, XacroThatWasNotExpandedIsRefusedByEveryCommand) {
  Write(Robot("500", R"(<box size="1 1 0.5"/>)", "  <xacro:arm parent=\"upper\"/>\n"), kFixed);
  const auto message = TellsOf("m.yaml:2:7: machines[0].machine.urdf: m.urdf:15: xacro:arm");
  ExpectRefused(scratch, {"check", "s.yaml"}, message);
  ExpectRefused(scratch, {"generate", "s.yaml", "--out", "run"}, message);
}

TEST_F(MachineFiles, MassAndSizeOfLinksStandBesideEachOther) {
  Write(kPlain, kFixed);
  const Outcome outcome = Check();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("2 links, 1 joints, 0 levers, 2000 kg"),
                                 ContainsRegex("link +mass kg +size m\n"),
                                 ContainsRegex("base_link +1500 +2 x 1.5 x 0.6\n"),
                                 ContainsRegex("upper +500 +1 x 1 x 0.5\n"),
                                 Not(HasSubstr("warning:")), EndsWith("valid\n")));
}

TEST_F(MachineFiles, PlaceholdersAreDoubted) {
  Write(Robot("0.03", R"(<box size="4 2.5 1.5"/>)"), kFixed);
  const Outcome outcome = Check();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  // The gyration radius is sqrt(1 / 0.03), half the diagonal 2.47 m.
  EXPECT_THAT(outcome.out, HasSubstr("\nwarning: m1, link upper: 0.03 kg, and its inertia (radius "
                                     "of gyration 5.77 m) is that of a body larger than its meshes "
                                     "(4 x 2.5 x 1.5 m): placeholders?\nvalid\n"));
}

TEST_F(MachineFiles, AMachineThatTouchesNothingIsToldAndItsRunStops) {
  Write(kPlain);
  const Outcome checked = Check();
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out,
              HasSubstr("\nwarning: m1 touches nothing and will fall: no tracks, wheels or "
                        "hull_points; give it these, or fixed_base: true\nvalid\n"));
  ExpectRefused(scratch, {"generate", "s.yaml", "--out", "run"},
                AllOf(HasSubstr("machine m1: has fallen below all ground at -0."),
                      HasSubstr("it touches nothing; give it tracks, wheels or hull_points, or "
                                "fixed_base: true")));
  Write(kPlain, kFixed);
  EXPECT_EQ(RunTera({"generate", "s.yaml", "--out", "run"}, {scratch.path()}).status, 0);
}

TEST_F(MachineFiles, MeshesThatAreNotThereAreLeftOutOnDemand) {
  Write(Robot("500", R"(<mesh filename="package://m_description/upper.dae"/>)"), kFixed);
  ExpectRefused(
      scratch, {"check", "s.yaml"},
      AllOf(HasSubstr("mesh 'package://m_description/upper.dae' does not exist"),
            HasSubstr("packages: {m_description: FOLDER}"), HasSubstr("--without-meshes")));
  const Outcome checked = Check({"--without-meshes"});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, AllOf(HasSubstr("\nm.urdf: meshes left out that are not there: "
                                           "package://m_description/upper.dae\n"),
                                 ContainsRegex("upper +500 +-\n")));
  // The written run can be repeated without the option.
  ASSERT_EQ(
      RunTera({"generate", "s.yaml", "--out", "run", "--without-meshes"}, {scratch.path()}).status,
      0);
  const Outcome again = RunTera({"replay", "run", "--out", "again"}, {scratch.path()});
  EXPECT_EQ(again.status, 0) << again.out << again.err;
}

TEST_F(MachineFiles, PackagesAreWhereTheMachineFileSays) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n";
  std::filesystem::create_directories(scratch.path() / "elsewhere");
  WriteWholeFile(scratch.path() / "elsewhere/upper.obj", triangle);
  Write(Robot("500", R"(<mesh filename="package://m_description/upper.obj"/>)"),
        std::string(kFixed) + "packages: {m_description: elsewhere}\n");
  const Outcome checked = Check();
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, ContainsRegex("upper +500 +1 x 1 x 0.5\n"));
  ASSERT_EQ(RunTera({"generate", "s.yaml", "--out", "run"}, {scratch.path()}).status, 0);
  EXPECT_EQ(RunTera({"replay", "run", "--out", "again"}, {scratch.path()}).status, 0);
}

}  // namespace
}  // namespace tera
