#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "own_folder.h"
#include "physics/description/urdf_left_out.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

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
    std::ofstream(file) << R"(<robot name="r"><link name="b"/><link name="a">)" + visual +
                               R"(</link><joint name="j" type="continuous"><parent link="a"/>
                                  <child link="b"/><axis xyz="0 0 1"/>)" +
                               joint + "</joint></robot>";
    return LeftOutOf(file);
  };
  const auto painted = [](const std::string& material) {
    return R"(<visual><geometry><box size="1 2 3"/></geometry><material name="m">)" + material +
           "</material></visual>";
  };
  const std::string red = R"(<color rgba="1 0 0 1"/>)", bricks = R"(<texture filename="b.png"/>)";
  EXPECT_EQ(left_out(painted(red), ""), "");
  EXPECT_EQ(left_out(painted(bricks), ""), "1 texture");
  EXPECT_EQ(left_out(painted(red), R"(<dynamics damping="0.1" friction="2"/>)"), "");
  EXPECT_EQ(left_out(painted(red), R"(<safety_controller k_velocity="10"/>)"),
            "1 safety controller");
}

TEST(Urdf, FaultsNameTheUrdfAndItsPart) {
  using testing::HasSubstr;
  EXPECT_THAT(FaultsOf(kFromUrdf, {"joints.trun.initial_deg=1"}),
              HasSubstr("the URDF has no joint 'trun'"));
  EXPECT_THAT(FaultsOf(kFromUrdf, {"links.antena.label=boom"}),
              HasSubstr("the URDF has no link 'antena'"));

  const std::string file = OwnFolder() / "broken.urdf";
  const auto faults_with = [&](const std::string& text) {
    std::ofstream(file) << text;
    return FaultsOf("kind: broken\nurdf: " + file + "\n");
  };
  EXPECT_THAT(faults_with("<robot"), HasSubstr("broken.urdf:1 is not valid XML"));
  EXPECT_THAT(faults_with("<robot name='r'>\n<link name='a'>\n</robot>"),
              HasSubstr("broken.urdf:2 is not valid XML (mismatched element); correct it"));
  EXPECT_THAT(faults_with(R"(<robot name="r"><link name="a"/><link name="b"/></robot>)"),
              HasSubstr("not a valid URDF: "));
  EXPECT_THAT(
      faults_with(R"(<robot name="r"><link name="a"/></robot>)"),
      HasSubstr("link 'a' of broken.urdf:1, mass_kg: 0 kg, and no link fixed to it has any"));
  EXPECT_THAT(faults_with(R"(<robot name="r"><link name="a">
      <inertial><mass value="-3"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      </link></robot>)"),
              HasSubstr("-3 kg; need a positive mass"));
  EXPECT_THAT(faults_with(R"(<robot name="r"><link name="a">
      <inertial><mass value="3"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      <visual><geometry><mesh filename="gone.stl"/></geometry></visual></link></robot>)"),
              HasSubstr("mesh 'gone.stl' does not exist"));
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
              HasSubstr("joint 'k' of broken.urdf:6, dynamics: damping is -2; need 0 or more"));
  EXPECT_THAT(rubbing(R"(<dynamics friction="-1" damping="1"/>)"),
              HasSubstr("dynamics: friction is -1; need 0 or more"));
  EXPECT_EQ(rubbing(R"(<dynamics friction="1" damping="1"/>)"), "");
  EXPECT_THAT(faults_with(R"(<robot name="r"><link name="a,b"/></robot>)"),
              HasSubstr("link 'a,b' of broken.urdf:1, name: need letters"));
}

}  // namespace
}  // namespace tera
