#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/faults.h"
#include "own_folder.h"
#include "physics/machine_fixture.h"

// Joints that follow others, by `mimic` as in URDF linkages.

namespace tera {
namespace {

using enum FaultKind;
using testing::ElementsAre;
using testing::HasSubstr;

std::string Bar(const std::string& name, double mass_kg) {
  // A bar of 1 m along x from its joint, its centre half way.
  return "<link name=\"" + name + "\"><inertial><origin xyz=\"0.5 0 0\"/><mass value=\"" +
         std::to_string(mass_kg) +
         "\"/><inertia ixx=\"0.01\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>"
         "</link>";
}

/// A joint about -y, so that positive angles raise its child.
std::string Hinge(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& limit, const std::string& mimic = "") {
  return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent +
         "\"/><child link=\"" + child +
         "\"/><origin xyz=\"0.2 0 1\"/><axis xyz=\"0 -1 0\"/><limit " + limit + "/>" + mimic +
         "</joint>\n";
}

const std::string kWide = R"(lower="-1" upper="1.2" velocity="0.5" effort="4000")";

/// An arm and a counterweight on a post, the second following by `mimic`.
std::string TwoBars(const std::string& mimic, const std::string& follower_limit = kWide,
                    const std::string& more = "") {
  return "<robot name=\"r\">" + Bar("post", 50) + Bar("arm", 20) + Bar("tail", 8) +
         Hinge("lift", "post", "arm", kWide) +
         Hinge("tilt", "post", "tail", follower_limit, mimic) + more + "</robot>";
}

std::string Machine(const std::string& urdf) {
  const std::string file = OwnFolder() / "bars.urdf";
  std::ofstream(file) << urdf;
  return "kind: bars\nfixed_base: true\nurdf: " + file + "\n";
}

const Joint& FollowingJoint(const MachineModel& model, const std::string& name) {
  return model.joints.at(model.JointIndex(name));
}

TEST(FollowingJoints, AMimicJointStandsWhereItsLeaderTakesIt) {
  const MachineModel model =
      MachineFromText(Machine(TwoBars(R"(<mimic joint="lift" multiplier="-0.5" offset="0.2"/>)")) +
                      "joints: {lift: {initial_deg: 20}}\nlevers: [lift]\n");
  const Joint& tilt = FollowingJoint(model, "tilt");
  ASSERT_TRUE(tilt.following.has_value());
  EXPECT_EQ(tilt.following->leader, model.JointIndex("lift"));
  // -0.5 * 20 deg + 0.2 rad, and as far as -0.5 * 1.2 + 0.2 to -0.5 * -1 + 0.2.
  EXPECT_NEAR(tilt.initial_rad, -10 * kDeg + 0.2, 1e-12);
  EXPECT_NEAR(tilt.lower_rad, -0.4, 1e-12);
  EXPECT_NEAR(tilt.upper_rad, 0.7, 1e-12);
  EXPECT_EQ(tilt.max_effort_nm, 0);
  EXPECT_TRUE(model.remarks.empty());
}

TEST(FollowingJoints, OneThatFollowsAFollowerFollowsTheFirst) {
  const MachineModel model = MachineFromText(Machine(
      TwoBars(R"(<mimic joint="lift" multiplier="2" offset="0.1"/>)",
              R"(lower="-9" upper="9" velocity="9" effort="1")",
              Bar("tip", 1) + Hinge("curl", "tail", "tip",
                                    R"(lower="-9" upper="9" velocity="9" effort="1")",
                                    R"(<mimic joint="tilt" multiplier="0.5" offset="-0.3"/>)"))));
  const Joint& curl = FollowingJoint(model, "curl");
  EXPECT_EQ(curl.following->leader, model.JointIndex("lift"));
  EXPECT_NEAR(curl.following->ratio, 1, 1e-12);
  EXPECT_NEAR(curl.following->offset, 0.5 * 0.1 - 0.3, 1e-12);
}

TEST(FollowingJoints, TheLeaderKeepsItsFollowerWithinItsLimits) {
  const MachineModel model =
      MachineFromText(Machine(TwoBars(R"(<mimic joint="lift" multiplier="2"/>)",
                                      R"(lower="-0.6" upper="1" velocity="0.6" effort="1")")));
  EXPECT_NEAR(FollowingJoint(model, "lift").lower_rad, -0.3, 1e-12);
  EXPECT_NEAR(FollowingJoint(model, "lift").upper_rad, 0.5, 1e-12);
  EXPECT_NEAR(FollowingJoint(model, "lift").max_rate_positive_radps, 0.3, 1e-12);
  EXPECT_THAT(model.remarks,
              ElementsAre("joint 'lift' moves from -17.19 to 28.65 deg, which keeps 'tilt', that "
                          "follows it, within its limits"));
}

TEST(FollowingJoints, FaultsNameTheJointThatCannotBeFollowed) {
  EXPECT_THAT(FaultsOf(Machine(TwoBars(R"(<mimic joint="lft"/>)"))),
              HasFault(kNoSuchName, "joint 'tilt' of bars.urdf:2, mimic"));
  EXPECT_THAT(FaultsOf(Machine(TwoBars(R"(<mimic joint="tilt"/>)"))),
              HasFault(kInconsistent, "mimic"));
  EXPECT_THAT(
      FaultsOf(Machine(TwoBars(
          R"(<mimic joint="bolt"/>)", kWide,
          Bar("box", 1) +
              R"(<joint name="bolt" type="fixed"><parent link="post"/><child link="box"/></joint>)"))),
      HasFault(kInconsistent, "mimic"));
  EXPECT_THAT(FaultsOf(Machine(TwoBars(R"(<mimic joint="lift" offset="3"/>)"))),
              HasFault(kInconsistent, "mimic"));
  // A resting follower must be within its limits.
  EXPECT_THAT(FaultsOf(Machine(TwoBars(R"(<mimic joint="lift" multiplier="0" offset="3"/>)",
                                       R"(lower="-1" upper="1" velocity="1" effort="1")"))),
              HasFault(kOutOfRange, "mimic"));
}

TEST(FollowingJoints, NothingElseMovesOne) {
  const std::string machine = Machine(TwoBars(R"(<mimic joint="lift"/>)"));
  EXPECT_THAT(FaultsOf(machine + "levers: [tilt]\n"), HasFault(kInconsistent, "levers"));
  EXPECT_THAT(FaultsOf(machine + "joints: {tilt: {max_effort_nm: 3}}\n"), HasFault(kInconsistent));
  EXPECT_THAT(FaultsOf(machine + R"(cylinders:
  ram:
    barrel: {link: post, pin_m: [0, 0, 0.5]}
    rod: {link: tail, pin_m: [0.4, 0, 0]}
    bore_m: 0.1
    rod_diameter_m: 0.05
    relief_pa: 1.0e7
)"),
              HasFaultAt("bore_m"));
  const MachineModel model = MachineFromText(Machine(
      TwoBars(R"(<mimic joint="lift"/>)", kWide,
              R"(<transmission name="t"><joint name="lift"/><actuator name="m"/></transmission>
         <transmission name="u"><joint name="tilt"/><actuator name="n"/></transmission>)")));
  ASSERT_EQ(model.levers.size(), 1u);
  EXPECT_EQ(model.levers[0].name, "lift");
  EXPECT_THAT(model.remarks, ElementsAre(HasSubstr("joint 'tilt' follows 'lift', and so has no "
                                                   "lever")));
}

TEST(FollowingJoints, MoveTogetherAndTheLeaderBearsBoth) {
  const double ratio = -0.5;
  const MachineModel model =
      MachineFromText(Machine(TwoBars(R"(<mimic joint="lift" multiplier="-0.5" offset="0.2"/>)")) +
                      "levers: [lift]\n");
  const int lift = model.JointIndex("lift"), tilt = model.JointIndex("tilt");
  MachineRun run(model, MakePose(Vec3(3, -2, 1), 0, 0, 0.8));
  run.input.levers = {1};
  for (int step = 0; step < 600; ++step) {
    run.Step();
    ASSERT_NEAR(run.state().q_rad[tilt], ratio * run.state().q_rad[lift] + 0.2, 1e-6) << step;
  }
  EXPECT_NEAR(run.state().q_rad[lift], 0.5 * 1.2, 0.01);
  EXPECT_NEAR(run.state().qd_radps[tilt], ratio * 0.5, 1e-6);
  run.input.levers = {0};
  run.Step(500);
  // Virtual work: the leader holds its own weight and ratio times that of its follower, each at
  // half a metre from its joint. The arm is level where its angle is zero.
  const double own_nm = 20 * kGravity_mps2 * 0.5 * std::cos(run.state().q_rad[lift]);
  const double follower_nm = 8 * kGravity_mps2 * 0.5 * std::cos(run.state().q_rad[tilt]);
  EXPECT_NEAR(run.state().effort_nm[lift], own_nm + ratio * follower_nm, 1e-3 * own_nm);
  EXPECT_NEAR(run.state().effort_nm[tilt], 0, 1e-9);
}

TEST(FollowingJoints, BothStopWhereTheLeaderStops) {
  const MachineModel model =
      MachineFromText(Machine(TwoBars(R"(<mimic joint="lift" multiplier="2"/>)",
                                      R"(lower="-0.6" upper="1" velocity="9" effort="1")")) +
                      "levers: [lift]\n");
  MachineRun run(model);
  run.input.levers = {1};
  run.StepFor(3);
  EXPECT_NEAR(run.state().q_rad[model.JointIndex("lift")], 0.5, 1e-4);
  EXPECT_NEAR(run.state().q_rad[model.JointIndex("tilt")], 1.0, 2e-4);
}

}  // namespace
}  // namespace tera
