#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/faults.h"
#include "own_folder.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

using enum FaultKind;

const std::string kFromUrdf =
    "kind: two_link\nfixed_base: true\nurdf: test/physics/data/two_link.urdf\n";

/// two_link.urdf written in TERA's keys.
const std::string kUrdfTwin = R"(
kind: two_link
fixed_base: true
links:
  base:
    mass_kg: 40
    com_m: [0, 0, 0.1]
    inertia_kgm2: [1.2, 1.4, 1.6]
    collision: [{xyz_m: [0, 0, 0.2], rpy_deg: [0, 0, 28.64788975654116], size_m: [0.4, 0.3, 0.2]}]
  upper: {mass_kg: 12, com_m: [0.4, 0.02, 0], inertia_kgm2: [0.1, 0.9, 0.95, 0.02, 0, 0.01]}
  slide: {mass_kg: 5, com_m: [0.1, 0, 0], inertia_kgm2: [0.05, 0.06, 0.07]}
joints:
  turn:
    type: revolute
    parent: base
    child: upper
    xyz_m: [0.1, 0, 0.5]
    rpy_deg: [11.459155902616466, 0, 17.188733853924695]
    axis: [0, -1, 0]
    limits_rad: [-1.5, 1.2]
    max_rate_degps: 45.836623610465864
    max_effort_nm: 600
  reach:
    type: prismatic
    parent: upper
    child: slide
    xyz_m: [0.9, 0, 0]
    axis: [1, 0, 0]
    limits_m: [0, 0.5]
    max_rate_mps: 0.25
    max_effort_n: 900
levers: [turn, reach]
)";

TEST(Urdf, MovesLikeItsTwinInTeraKeys) {
  const MachineModel urdf = MachineFromText(kFromUrdf + "levers: [turn, reach]\n");
  const MachineModel twin = MachineFromText(kUrdfTwin);
  const Pose X_WB = MakePose(Vec3(1, 2, 3), 0.1, -0.2, 0.7);
  MachineRun a(urdf, X_WB), b(twin, X_WB);
  a.input.levers = b.input.levers = {0.7, 0.9};
  a.StepFor(1.0);
  b.StepFor(1.0);
  for (const char* name : {"turn", "reach"}) {
    const int i = urdf.JointIndex(name), j = twin.JointIndex(name);
    EXPECT_GT(std::abs(a.state().q_rad[i]), 0.1);
    EXPECT_NEAR(a.state().q_rad[i], b.state().q_rad[j], 1e-9);
    EXPECT_NEAR(a.state().effort_nm[i], b.state().effort_nm[j], 1e-6);
  }
  EXPECT_TRUE(a.state().links[urdf.LinkIndex("slide")].X_WB.isApprox(
      b.state().links[twin.LinkIndex("slide")].X_WB, 1e-9));
}

TEST(Urdf, ReadsCollisionBoxesAndFixedFrames) {
  const MachineModel urdf = MachineFromText(kFromUrdf);
  const MachineModel twin = MachineFromText(kUrdfTwin);
  ASSERT_EQ(urdf.links[0].collision.size(), 1u);
  EXPECT_TRUE(urdf.links[0].collision[0].X_BG.isApprox(twin.links[0].collision[0].X_BG, 1e-12));
  EXPECT_TRUE(urdf.links[0].collision[0].size_m.isApprox(Vec3(0.4, 0.3, 0.2)));
  EXPECT_EQ(urdf.links[urdf.LinkIndex("antenna")].mass_kg, 0);
}

TEST(Urdf, TeraKeysLieOverIt) {
  const MachineModel model =
      MachineFromText(kFromUrdf, {"links.upper.label=boom", "joints.turn.max_rate_degps=[10, 5]",
                                  "joints.turn.initial_deg=20", "joints.reach.max_effort_n=77"});
  EXPECT_EQ(model.links[model.LinkIndex("upper")].label, SemanticClass::kBoom);
  const Joint& turn = model.joints[model.JointIndex("turn")];
  EXPECT_DOUBLE_EQ(turn.max_rate_positive_radps, 10 * kDeg);
  EXPECT_DOUBLE_EQ(turn.max_rate_negative_radps, 5 * kDeg);
  EXPECT_DOUBLE_EQ(turn.initial_rad, 20 * kDeg);
  EXPECT_DOUBLE_EQ(turn.max_effort_nm, 600);
  EXPECT_DOUBLE_EQ(model.joints[model.JointIndex("reach")].max_effort_nm, 77);
}

TEST(Urdf, WhatIsLeftOutIsCounted) {
  const std::string file = OwnFolder() / "left_out.urdf";
  const auto left_out = [&](const std::string& visual, const std::string& joint) {
    const std::string mass = R"(<inertial><mass value="3"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>)";
    std::ofstream(file) << R"(<robot name="r"><link name="b">)" + mass +
                               R"(</link><link name="a">)" + visual +
                               R"(</link><joint name="j" type="continuous">
                                  <parent link="a"/><child link="b"/><axis xyz="0 0 1"/>)" +
                               joint + "</joint></robot>";
    const auto remarks = MachineFromText("kind: r\nfixed_base: true\nurdf: " + file + "\n").remarks;
    return remarks.empty() ? "" : remarks.at(0);
  };
  const auto painted = [](const std::string& material) {
    return R"(<visual><geometry><box size="1 2 3"/></geometry><material name="m">)" + material +
           "</material></visual>";
  };
  const std::string red = R"(<color rgba="1 0 0 1"/>)", bricks = R"(<texture filename="b.png"/>)";
  EXPECT_EQ(left_out(painted(red), ""), "");
  EXPECT_EQ(left_out(painted(bricks), ""), "left_out.urdf: 1 texture left out");
  EXPECT_EQ(left_out(painted(red), R"(<dynamics damping="0.1" friction="2"/>)"), "");
  EXPECT_EQ(left_out(painted(red), R"(<safety_controller k_velocity="10"/>)"),
            "left_out.urdf: 1 safety controller left out");
}

TEST(Urdf, FaultsNameTheUrdfAndItsPart) {
  EXPECT_THAT(FaultsOf(kFromUrdf, {"joints.trun.initial_deg=1"}),
              HasFault(kNoSuchName, "joints.trun"));
  EXPECT_THAT(FaultsOf(kFromUrdf, {"links.antena.label=boom"}),
              HasFault(kNoSuchName, "links.antena"));

  const std::string file = OwnFolder() / "broken.urdf";
  const auto faults_with = [&](const std::string& text) {
    std::ofstream(file) << text;
    return FaultsOf("kind: broken\nurdf: " + file + "\n");
  };
  EXPECT_THAT(faults_with("<robot"), HasFault(kMalformed, "urdf"));
  EXPECT_THAT(faults_with("<robot name='r'>\n<link name='a'>\n</robot>"),
              HasFault(kMalformed, "urdf"));
  EXPECT_THAT(faults_with(R"(<robot name="r"><link name="a"/><link name="b"/></robot>)"),
              HasFault(kMalformed, "urdf"));
  EXPECT_THAT(faults_with(R"(<robot name="r"><link name="a"/></robot>)"),
              HasFault(kOutOfRange, "mass_kg"));
  EXPECT_THAT(faults_with(R"(<robot name="r"><link name="a">
      <inertial><mass value="-3"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      </link></robot>)"),
              HasFault(kOutOfRange, "mass_kg"));
  EXPECT_THAT(faults_with(R"(<robot name="r"><link name="a">
      <inertial><mass value="3"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      <visual><geometry><mesh filename="gone.stl"/></geometry></visual></link></robot>)"),
              HasFault(kUnreadable));
  const auto rubbing = [&](const std::string& dynamics) {
    return faults_with(R"(<robot name="r"><link name="a"><inertial><mass value="3"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link><link name="b"/>
      <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
      <link name="c"><inertial><mass value="3"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="k" type="continuous"><parent link="a"/><child link="c"/>)" +
                       dynamics + "</joint></robot>");
  };
  EXPECT_THAT(rubbing(R"(<dynamics damping="-2"/>)"),
              HasFault(kOutOfRange, "joint 'k' of broken.urdf:6, dynamics"));
  EXPECT_THAT(rubbing(R"(<dynamics friction="-1" damping="1"/>)"),
              HasFault(kOutOfRange, "dynamics"));
  EXPECT_THAT(rubbing(R"(<dynamics friction="1" damping="1"/>)"), testing::IsEmpty());
  EXPECT_THAT(
      faults_with("<robot name=\"r\"><link name=\"" + std::string(101, 'a') + "\"/></robot>"),
      HasFault(kMalformed, "name"));
}

constexpr const char* kMass =
    R"(<inertial><mass value="3"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>)";

TEST(Urdf, NamesGetSignsThatFilesCanHaveAndAreTold) {
  const std::string file = OwnFolder() / "names.urdf";
  const auto machine = [&](const std::string& second) {
    std::ofstream(file) << R"(<robot name="r"><link name="base/body">)" << kMass
                        << R"(</link><link name=")" << second << "\">" << kMass
                        << R"(</link><joint name="arm joint/1" type="revolute">
      <parent link="base/body"/><child link=")"
                        << second << R"("/><axis xyz="0 0 1"/>
      <limit lower="0" upper="1" velocity="1" effort="1"/></joint><transmission name="t">
      <joint name="arm joint/1"/><actuator name="m"/></transmission></robot>)";
    return "kind: r\nfixed_base: true\nurdf: " + file + "\n";
  };
  const MachineModel model =
      MachineFromText(machine("br\u00fcckenarm") + "links: {base_body: {label: boom}}\n");
  EXPECT_EQ(model.links[0].name, "base_body");
  EXPECT_EQ(model.links[1].name, "br_ckenarm");  // one position for each character, of any number
                                                 // of bytes
  EXPECT_EQ(model.levers.at(0).name, "arm_joint_1");
  EXPECT_THAT(model.remarks, testing::ElementsAre(
                                 "names.urdf: names get signs that files can have: 'base/body' is "
                                 "base_body, 'br\u00fcckenarm' is br_ckenarm, 'arm joint/1' is "
                                 "arm_joint_1"));
  EXPECT_THAT(FaultsOf(machine("base_body")), HasFault(kInconsistent, "name"));
}

TEST(Urdf, MeshesOfPackagesAreWhereTheMachineFileSays) {
  const std::filesystem::path folder = OwnFolder();
  std::filesystem::create_directories(folder / "elsewhere/meshes");
  std::filesystem::create_directories(folder / "robot");
  std::ofstream(folder / "elsewhere/meshes/arm.stl") << "solid\n";
  std::ofstream(folder / "robot/r.urdf")
      << R"(<robot name="r"><link name="a">)" << kMass
      << R"(<visual><geometry><mesh filename="package://r_description/meshes/arm.stl"/></geometry>
      </visual></link></robot>)";
  const std::string machine =
      "kind: r\nfixed_base: true\nurdf: " + (folder / "robot/r.urdf").string() + "\n";
  EXPECT_THAT(FaultsOf(machine), HasFault(kUnreadable));
  const std::string packages =
      "packages: {r_description: " + (folder / "elsewhere").string() + "}\n";
  const MachineModel model = MachineFromText(machine + packages);
  EXPECT_EQ(model.links[0].visuals.at(0).mesh, folder / "elsewhere/meshes/arm.stl");
  EXPECT_THAT(FaultsOf(machine + "packages: {r_description: " + (folder / "no").string() + "}\n"),
              HasFault(kUnreadable));
}

TEST(Urdf, MeshesThatAreNotThereMayBeLeftOut) {
  const std::string file = OwnFolder() / "bare.urdf";
  std::ofstream(file) << R"(<robot name="r"><link name="a">)" << kMass << R"(
      <visual><geometry><box size="1 2 3"/></geometry></visual>
      <visual><geometry><mesh filename="arm.dae"/></geometry></visual>
      <collision><geometry><mesh filename="arm.dae"/></geometry></collision></link></robot>)";
  const Config config =
      Config::FromText("kind: r\nfixed_base: true\nurdf: " + file + "\n", "test.yaml");
  const MachineModel model = ReadMachine(config.root(), AbsentMeshes::kLeftOut);
  config.Finish();
  EXPECT_EQ(model.links[0].visuals.size(), 1u);
  EXPECT_TRUE(model.links[0].collision_meshes.empty());
  EXPECT_THAT(model.remarks,
              testing::ElementsAre("bare.urdf: meshes left out that are not there: arm.dae"));
}

/// A cart on wheels that are joints; the left one's axle points to the right.
std::string Cart(const std::string& type = "continuous", const std::string& axis = "0 -1 0") {
  const std::string file = OwnFolder() / "cart.urdf";
  const auto wheel = [&](const std::string& name, const std::string& kind, const std::string& xyz,
                         const std::string& about) {
    return "<link name=\"" + name + "\">" + kMass + "</link><joint name=\"" + name +
           "_turn\" type=\"" + kind + "\"><parent link=\"a\"/><child link=\"" + name +
           "\"/><origin xyz=\"" + xyz + "\"/><axis xyz=\"" + about +
           "\"/><limit lower=\"-1\" upper=\"1\" velocity=\"9\" effort=\"9\"/></joint>";
  };
  std::ofstream(file) << R"(<robot name="r"><link name="a">)" << kMass << "</link>"
                      << wheel("front", "continuous", "0.7 0.5 0.3", "0 1 0")
                      << wheel("rear", type, "-0.6 0.5 0.3", axis) << "</robot>";
  return "kind: r\nfixed_base: true\nurdf: " + file + "\nwheels:\n  left:\n    joints: " +
         "[front_turn, rear_turn]\n    radius_m: 0.3\n    width_m: 0.2\n    max_speed_mps: 1.5\n" +
         "    max_torque_nm: 100\n    inertia_kgm2: 2\n";
}

TEST(Urdf, WheelsThatAreJointsRollWhereTheyAreAndTurnWithTheirSet) {
  const MachineModel model = MachineFromText(Cart() + "levers: [left]\n");
  ASSERT_EQ(model.ground_tools.gears.size(), 1u);
  const RunningGear& gear = model.ground_tools.gears[0];
  EXPECT_EQ(gear.link, 0);
  // The lowest patches lie a radius below the axles.
  double lowest_m = 1, front_m = 0, rear_m = 0;
  for (const ContactPatch& patch : gear.patches) {
    lowest_m = std::min(lowest_m, patch.p_B_m.z());
    front_m = std::max(front_m, patch.p_B_m.x());
    rear_m = std::min(rear_m, patch.p_B_m.x());
    EXPECT_DOUBLE_EQ(patch.p_B_m.y(), 0.5);
  }
  EXPECT_NEAR(lowest_m, 0, 1e-9);
  EXPECT_GT(front_m, 0.7);
  EXPECT_LT(rear_m, -0.6);
  MachineRun run(model, MakePose(Vec3(1, 2, 3), 0.1, -0.2, 0.7));
  run.input.levers = {1};
  run.StepFor(2.0);
  const double turned_rad = run.state().gear_angle_rad[0];
  EXPECT_GT(turned_rad, 2);
  EXPECT_NEAR(run.state().q_rad[model.JointIndex("front_turn")], turned_rad, 1e-6);
  EXPECT_NEAR(run.state().q_rad[model.JointIndex("rear_turn")], -turned_rad, 1e-6);
}

TEST(Urdf, AWheelSetTakesNoJointThatIsNoWheels) {
  EXPECT_THAT(FaultsOf(Cart("revolute")), HasFault(kInconsistent));
  EXPECT_THAT(FaultsOf(Cart("continuous", "0 0 1")), HasFault(kInconsistent));
  EXPECT_THAT(FaultsOf(Cart() + "levers: [rear_turn]\n"), HasFault(kInconsistent, "levers"));
  EXPECT_THAT(FaultsOf(Cart(), {"wheels.left.joints=[front_turn, rear]"}), HasFault(kNoSuchName));
  EXPECT_THAT(FaultsOf(Cart(), {"wheels.left.axles_m=[[0, 0, 0]]"}),
              HasFault(kUnknown, "wheels.left.axles_m"));
  EXPECT_THAT(FaultsOf(Cart(), {"wheels.left.joints=[front_turn, front_turn]"}),
              HasFault(kInconsistent));
}

}  // namespace
}  // namespace tera
