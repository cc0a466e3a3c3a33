#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "own_folder.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

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
  EXPECT_NEAR(rate("roll"), 0.25 * 3.0, 1e-3);  // its command interface allows less than the joint
  EXPECT_NEAR(rate("elbow"), 0, 1e-3);          // held against its weight
}

TEST(UrdfTransmission, AJointWithoutDriveSwingsFreely) {
  // The flange's weight hangs 5 cm beside the axis of `spin`, which lies level.
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
std::string TransmissionFaultsWith(const std::string& passage, const std::string& by) {
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
  EXPECT_THAT(
      TransmissionFaultsWith(shoulder, R"(<joint name="sholder"><hardwareInterface>)"),
      HasSubstr("transmission 'shoulder_drive' of arm.urdf:101, joint: the URDF has no joint "
                "'sholder' (did you mean 'shoulder'?)"));
  EXPECT_THAT(TransmissionFaultsWith(">-160<", ">0<"),
              HasSubstr("mechanicalReduction: '0'; need a number that is not zero"));
  EXPECT_THAT(TransmissionFaultsWith(">-160<", ">many<"),
              HasSubstr("'many'; need a number that is not zero"));
  EXPECT_THAT(TransmissionFaultsWith(shoulder, R"(<joint name="waist"><hardwareInterface>)"),
              HasSubstr("joint 'waist' is driven by transmission 'waist_drive'"));
  EXPECT_THAT(TransmissionFaultsWith("/EffortJointInterface", "/TorqueInterface"),
              HasSubstr("hardwareInterface: 'TorqueInterface' is not known, need one of Position"));
  EXPECT_THAT(TransmissionFaultsWith(shoulder, R"(<joint name="elbow"/>)" + shoulder),
              HasSubstr("2 joints and 1 actuators; need one of each"));
  EXPECT_THAT(
      TransmissionFaultsWith("SimpleTransmission</type>", "DifferentialTransmission</type>"),
      HasSubstr("type: 'transmission_interface/DifferentialTransmission' is not supported"));
  EXPECT_THAT(
      TransmissionFaultsWith("SimpleTransmission</plugin>", "FourBarLinkageTransmission</plugin>"),
      HasSubstr("plugin: 'transmission_interface/FourBarLinkageTransmission' is not"));
  EXPECT_THAT(TransmissionFaultsWith(R"(name="effort"><param name="min">-45)",
                                     R"(name="torque"><param name="min">-45)"),
              HasSubstr("'torque' is not known, need position, velocity or effort"));
  EXPECT_THAT(TransmissionFaultsWith(">-2.0</param>", ">fast</param>"),
              HasSubstr("velocity: min is 'fast', need a number"));
  EXPECT_THAT(TransmissionFaultsWith(">-2.0</param>", ">4.0</param>"),
              HasSubstr("velocity: min 4 is not below max 3"));
  EXPECT_THAT(TransmissionFaultsWith(">-2.0</param>", ">1.0</param>"),
              HasSubstr("velocity: need min below and max above zero"));
  EXPECT_THAT(
      FaultsOf(kArm + "actuators: {shoulder_moter: {max_effort_nm: 4}}\n"),
      HasSubstr("no transmission of the URDF has an actuator 'shoulder_moter' (did you mean "
                "'shoulder_motor'?)"));
  EXPECT_THAT(FaultsOf(kArm + "actuators: {shoulder_motor: {max_effort_nm: -4}}\n"),
              HasSubstr("max_effort_nm"));
}

TEST(UrdfTransmission, ADrivenJointNeedsLimits) {
  EXPECT_THAT(TransmissionFaultsWith(R"(<limit effort="900" velocity="2.0"/>)", ""),
              HasSubstr("joint 'waist' of arm.urdf:60, velocity: it is driven but has no velocity "
                        "limit; give it in <limit>, or max_rate_degps in `joints:`"));
  EXPECT_THAT(
      TransmissionFaultsWith(R"(effort="900" velocity="1.6")", R"(effort="0" velocity="1.6")"),
      HasSubstr("joint 'shoulder' of arm.urdf:66, effort: it is driven but has no effort"));
  EXPECT_THAT(TransmissionFaultsWith(R"(<joint name="spin">
      <state_interface name="position"/>)",
                                     R"(<joint name="spinn">)"),
              HasSubstr("ros2_control joint 'spinn' of arm.urdf"));
}

}  // namespace
}  // namespace tera
