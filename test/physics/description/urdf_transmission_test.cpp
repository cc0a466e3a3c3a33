#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/faults.h"
#include "own_folder.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::ElementsAre;

const std::string kArm =
    "kind: six_axis\nfixed_base: true\nurdf: test/physics/data/six_axis.urdf\n";

const Joint& JointOf(const MachineModel& model, const std::string& name) {
  return model.joints[model.JointIndex(name)];
}

std::vector<std::string> LeverNames(const MachineModel& model) {
  std::vector<std::string> names;
  for (const Lever& lever : model.levers) names.push_back(lever.name);
  return names;
}

TEST(UrdfTransmission, DrivenJointsAreTheLeversUnlessTheMachineNamesThem) {
  const MachineModel model = MachineFromText(kArm);
  EXPECT_THAT(LeverNames(model), ElementsAre("waist", "shoulder", "elbow", "roll", "bend"));
  const MachineModel named = MachineFromText(kArm + "levers: [elbow, waist]\n");
  EXPECT_THAT(LeverNames(named), ElementsAre("elbow", "waist"));
  EXPECT_TRUE(
      MachineFromText("kind: two_link\nurdf: test/physics/data/two_link.urdf\n").levers.empty());
}

TEST(UrdfTransmission, ALeverAsksForTheVelocityLimitOfItsJoint) {
  const MachineModel model = MachineFromText(kArm);
  MachineRun run(model);
  run.input.levers = {-0.5, 0, 0, 0.25, 0};
  run.StepFor(0.5);
  const auto rate = [&](const char* joint) {
    return run.state().qd_radps[model.JointIndex(joint)];
  };
  EXPECT_NEAR(rate("waist"), -0.5 * 2.0, 1e-3);
  EXPECT_NEAR(rate("roll"), 0.25 * 3.0, 1e-3);  // its command interface has a lower limit than the
                                                // joint
  EXPECT_NEAR(rate("elbow"), 0, 1e-3);          // held against its weight
}

TEST(UrdfTransmission, AJointWithoutDriveSwingsFreely) {
  // The flange's weight hangs 5 cm to the side of the level axis of `spin`.
  const auto turned_rad = [](const MachineModel& model) {
    MachineRun run(model);
    run.StepFor(0.3);
    return std::abs(run.state().q_rad[model.JointIndex("spin")]);
  };
  EXPECT_GT(turned_rad(MachineFromText(kArm)), 0.5);
  EXPECT_LT(turned_rad(MachineFromText(kArm, {"joints.spin.max_effort_nm=5"})), 1e-3);
}

TEST(UrdfTransmission, CommandInterfacesNarrowTheLimitsOfTheirJoint) {
  const MachineModel model = MachineFromText(kArm);
  const Joint& roll = JointOf(model, "roll");
  EXPECT_DOUBLE_EQ(roll.lower_rad, -2.5);
  EXPECT_DOUBLE_EQ(roll.upper_rad, 2.0);
  EXPECT_DOUBLE_EQ(roll.max_rate_positive_radps, 3.0);
  EXPECT_DOUBLE_EQ(roll.max_rate_negative_radps, 2.0);
  EXPECT_DOUBLE_EQ(roll.max_effort_nm, 80);
  EXPECT_DOUBLE_EQ(JointOf(model, "bend").max_effort_nm, 45);
  EXPECT_DOUBLE_EQ(JointOf(model, "bend").max_rate_positive_radps, 4.5);
}

TEST(UrdfTransmission, AReductionTurnsTheActuatorsLimitsIntoTheJoints) {
  // A motor of 3000 rpm = 18000 deg/s and 4 N m behind 1:160: 112.5 deg/s and 640 N m.
  const MachineModel model =
      MachineFromText(kArm, {"actuators.shoulder_motor={max_rate_degps: 18000, max_effort_nm: 4}",
                             "actuators.elbow_motor={max_rate_degps: 18000, max_effort_nm: 4}",
                             "actuators.bend_motor={max_rate_degps: 18000}"});
  const Joint& shoulder = JointOf(model, "shoulder");
  EXPECT_NEAR(shoulder.max_effort_nm, 640, 1e-9);
  EXPECT_NEAR(shoulder.max_rate_positive_radps, 1.6,
              1e-12);                            // its own limit, less than 112.5 deg/s
  const Joint& elbow = JointOf(model, "elbow");  // 1:120 gives 150 deg/s, 480 N m; own: 400 N m
  EXPECT_NEAR(elbow.max_effort_nm, 400, 1e-9);
  EXPECT_NEAR(elbow.max_rate_negative_radps, 2.4, 1e-12);
  EXPECT_NEAR(JointOf(model, "bend").max_rate_positive_radps, 225 * kDeg, 1e-12);  // 1:80
}

TEST(UrdfTransmission, TheMachinesOwnKeysHoldOverTheUrdf) {
  const MachineModel model =
      MachineFromText(kArm, {"actuators.shoulder_motor={max_effort_nm: 4}",
                             "joints.shoulder={max_rate_degps: [20, 30], max_effort_nm: 700}"});
  EXPECT_NEAR(JointOf(model, "shoulder").max_rate_positive_radps, 20 * kDeg, 1e-12);
  EXPECT_NEAR(JointOf(model, "shoulder").max_rate_negative_radps, 30 * kDeg, 1e-12);
  EXPECT_DOUBLE_EQ(JointOf(model, "shoulder").max_effort_nm, 700);
}

/// The faults of the arm with one passage of its URDF replaced.
std::vector<InputFault> TransmissionFaultsWith(const std::string& passage, const std::string& by) {
  std::ifstream in("test/physics/data/six_axis.urdf");
  std::stringstream read;
  read << in.rdbuf();
  std::string text = read.str();
  const std::size_t at = text.find(passage);
  EXPECT_NE(at, std::string::npos) << passage;
  text.replace(at, passage.size(), by);
  const std::string file = OwnFolder() / "arm.urdf";
  std::ofstream(file) << text;
  return FaultsOf("kind: six_axis\nurdf: " + file + "\n");
}

TEST(UrdfTransmission, FaultsSayWhatTheDriveNeeds) {
  const std::string shoulder = R"(<joint name="shoulder"><hardwareInterface>)";
  EXPECT_THAT(TransmissionFaultsWith(shoulder, R"(<joint name="sholder"><hardwareInterface>)"),
              HasFault(kNoSuchName, "transmission 'shoulder_drive' of arm.urdf:101, joint"));
  EXPECT_THAT(TransmissionFaultsWith(">-160<", ">0<"), HasFault(kMistyped, "mechanicalReduction"));
  EXPECT_THAT(TransmissionFaultsWith(">-160<", ">many<"),
              HasFault(kMistyped, "mechanicalReduction"));
  EXPECT_THAT(TransmissionFaultsWith(shoulder, R"(<joint name="waist"><hardwareInterface>)"),
              HasFault(kRepeated, "joint"));
  EXPECT_THAT(TransmissionFaultsWith("/EffortJointInterface", "/TorqueInterface"),
              HasFault(kNoSuchName, "hardwareInterface"));
  EXPECT_THAT(TransmissionFaultsWith(shoulder, R"(<joint name="elbow"/>)" + shoulder),
              HasFault(kUnsupported, "joint"));
  EXPECT_THAT(
      TransmissionFaultsWith("SimpleTransmission</type>", "DifferentialTransmission</type>"),
      HasFault(kUnsupported, "type"));
  EXPECT_THAT(
      TransmissionFaultsWith("SimpleTransmission</plugin>", "FourBarLinkageTransmission</plugin>"),
      HasFault(kUnsupported, "plugin"));
  EXPECT_THAT(TransmissionFaultsWith(R"(name="effort"><param name="min">-45)",
                                     R"(name="torque"><param name="min">-45)"),
              HasFault(kNoSuchName, "command_interface"));
  EXPECT_THAT(TransmissionFaultsWith(">-2.0</param>", ">fast</param>"),
              HasFault(kMistyped, "velocity"));
  EXPECT_THAT(TransmissionFaultsWith(">-2.0</param>", ">4.0</param>"),
              HasFault(kInconsistent, "velocity"));
  EXPECT_THAT(TransmissionFaultsWith(">-2.0</param>", ">1.0</param>"),
              HasFault(kInconsistent, "velocity"));
  EXPECT_THAT(FaultsOf(kArm + "actuators: {shoulder_moter: {max_effort_nm: 4}}\n"),
              HasFault(kNoSuchName, "actuators"));
  EXPECT_THAT(FaultsOf(kArm + "actuators: {shoulder_motor: {max_effort_nm: -4}}\n"),
              HasFault(kOutOfRange, "max_effort_nm"));
}

TEST(UrdfTransmission, ADrivenJointNeedsLimits) {
  EXPECT_THAT(TransmissionFaultsWith(R"(<limit effort="900" velocity="2.0"/>)", ""),
              HasFault(kInconsistent, "joint 'waist' of arm.urdf:60, velocity"));
  EXPECT_THAT(
      TransmissionFaultsWith(R"(effort="900" velocity="1.6")", R"(effort="0" velocity="1.6")"),
      HasFault(kInconsistent, "joint 'shoulder' of arm.urdf:66, effort"));
  EXPECT_THAT(TransmissionFaultsWith(R"(<joint name="spin">
      <state_interface name="position"/>)",
                                     R"(<joint name="spinn">)"),
              HasFault(kNoSuchName, "joint"));
}

}  // namespace
}  // namespace tera
