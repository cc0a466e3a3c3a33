#include "sim/operators/remote_operator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/units.h"
#include "remote_machine.h"

// Remote control of a machine by rates, positions and tool poses.

namespace tera {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class RemoteOperatorTest : public RemoteMachineTest {};

TEST_F(RemoteOperatorTest, TurnsJointsAtTheRatesAskedFor) {
  const double boom_rad = Angle("boom"), slew_rad = Angle("slew");
  Drive({.command = ControlMessage::JointRates{ByLever({{"boom", -0.1}, {"slew", 0.4}})}}, 3.0);
  EXPECT_NEAR(Angle("boom") - boom_rad, -0.3, 0.02);
  EXPECT_NEAR(Angle("slew") - slew_rad, 1.2, 0.08);  // from rest, held up by its inertia
}

TEST_F(RemoteOperatorTest, TakesJointsToTheAnglesAskedFor) {
  Drive({.command = ControlMessage::JointPositions{ByLever(
             {{"boom", 0.5}, {"arm", -1.4}, {"bucket", 0.3}, {"slew", -0.6}, {"blade", 0.1}})}},
        6.0);
  EXPECT_NEAR(Angle("boom"), 0.5, 0.01);
  EXPECT_NEAR(Angle("arm"), -1.4, 0.01);
  EXPECT_NEAR(Angle("bucket"), 0.3, 0.01);
  EXPECT_NEAR(Angle("slew"), -0.6, 0.01);
  EXPECT_NEAR(Angle("swing"), 0.0, 0.01);
}

TEST_F(RemoteOperatorTest, TakesTheBucketTipToAPlace) {
  const Vec3 target_m(3.2, 1.1, 0.8);
  Drive({.command = ControlMessage::ToolPose{"bucket_tip", {target_m, std::nullopt}}}, 8.0);
  EXPECT_LT((TipInRoot() - target_m).norm(), 0.03) << TipInRoot().transpose();
}

TEST_F(RemoteOperatorTest, TakesTheBucketTipToAPlaceAndAPitch) {
  // Teeth almost straight down, in the vertical plane through slew axis and target.
  const Vec3 target_m(4.0, 1.3, 0.8);
  const double azimuth_rad = std::atan2(1.3, 4.0), down_rad = 1.3;
  const Mat3 R_BF = RotationFromRpy(0, down_rad, azimuth_rad);
  Drive({.command = ControlMessage::ToolPose{"bucket_tip", {target_m, R_BF}}}, 10.0);
  EXPECT_LT((TipInRoot() - target_m).norm(), 0.05) << TipInRoot().transpose();
  const NamedFrame& tip = model().frames[0];
  const Mat3 R = state().links[0].X_WB.linear().transpose() *
                 state().links[tip.link].X_WB.linear() * tip.X_BF.linear();
  EXPECT_NEAR(std::asin(-R(2, 0)), down_rad, 0.05);
}

TEST_F(RemoteOperatorTest, DrivesSlowlyInLowSpeed) {
  ControlMessage message{
      .command = ControlMessage::Levers{ByLever({{"left_track", 1.0}, {"right_track", 1.0}})}};
  message.high_speed = false;
  Drive(message, 3.0);
  // 2.6 km/h of the data sheet's second speed, over the radius of the shoes.
  EXPECT_NEAR(state().gear_rate_radps[0], 2.6 / 3.6 / 0.25, 0.05);
}

TEST_F(RemoteOperatorTest, TurnsSprocketsAtTheRatesAskedForUpToThoseOfTheSpeedChosen) {
  ControlMessage message{
      .command = ControlMessage::JointRates{ByLever({{"left_track", 2.0}, {"right_track", 4.5}})}};
  message.high_speed = false;
  Drive(message, 3.0);
  EXPECT_NEAR(state().gear_rate_radps[0], 2.0, 0.05);
  EXPECT_NEAR(state().gear_rate_radps[1], 2.6 / 3.6 / 0.25, 0.05);  // the low speed's limit
}

TEST_F(RemoteOperatorTest, StandsWhenLockedOrNotEnabled) {
  const auto moving = ByLever({{"slew", 1.0}, {"boom", -0.5}});
  ControlMessage message{.command = ControlMessage::Levers{moving}};
  Drive(message, 0.2);
  EXPECT_EQ(state().levers, moving);
  message.hydraulic_lock = true;
  Drive(message, 0.1);
  EXPECT_EQ(state().levers, ByLever({}));
  message.hydraulic_lock = false;
  Drive(message, 0.1);
  EXPECT_EQ(state().levers, moving);
  message.enable = false;
  Drive(message, 0.1);
  EXPECT_EQ(state().levers, ByLever({}));
}

TEST_F(RemoteOperatorTest, NamesWhatIsWrongWithAMessage) {
  using testing::HasSubstr;
  using testing::Optional;
  const auto fault = [&](const ControlMessage& message) { return FaultOf(message, model()); };
  EXPECT_THAT(fault({.command = ControlMessage::Levers{{0, 0}}}),
              Optional(HasSubstr("2 lever positions, need 8")));
  EXPECT_THAT(fault({.command = ControlMessage::Levers{ByLever({{"arm", 1.5}})}}),
              Optional(HasSubstr("lever 'arm' is 1.5, need -1 to 1")));
  EXPECT_THAT(fault({.command = ControlMessage::Levers{ByLever({{"arm", kNan}})}}),
              Optional(HasSubstr("'arm' is nan")));
  EXPECT_THAT(fault({.command = ControlMessage::JointRates{ByLever({{"slew", kNan}})}}),
              Optional(HasSubstr("joint rates of 'slew'")));
  EXPECT_THAT(fault({.command = ControlMessage::JointPositions{{}}}),
              Optional(HasSubstr("0 joint positions")));
  const auto bent = [&](double boom_rad) {
    return ControlMessage{
        .command = ControlMessage::JointPositions{ByLever({{"boom", boom_rad}, {"arm", -1.0}})}};
  };
  EXPECT_EQ(fault(bent(72 * kDeg)), std::nullopt);
  EXPECT_THAT(fault(bent(3)), Optional(HasSubstr("3 of 'boom' is beyond the joint's limits")));
  EXPECT_THAT(fault(bent(-1)), Optional(HasSubstr("-1 of 'boom'")));
  EXPECT_THAT(fault({.command = ControlMessage::ToolPose{"bucket", {}}}),
              Optional(HasSubstr("no frame 'bucket'")));
  EXPECT_THAT(fault({.command = ControlMessage::ToolPose{"bucket_tip", {Vec3(0, -1e308, 0), {}}}}),
              Optional(HasSubstr("beyond 1000 m")));
  EXPECT_THAT(fault({.command = ControlMessage::ToolPose{"bucket_tip", {Vec3(kNan, 0, 0), {}}}}),
              Optional(HasSubstr("finite")));
  EXPECT_THAT(
      fault({.command = ControlMessage::ToolPose{"bucket_tip",
                                                 {Vec3(3, 0, 0), Mat3(2 * Mat3::Identity())}}}),
      Optional(HasSubstr("rotation")));
}

TEST(ToolServo, MovesTheFrameTowardsItsTargetAndNoFasterThanTheJointsCan) {
  const Scenario scenario = RemoteScenario();
  const MachineModel& model = scenario.machines[0].placement.model;
  const Pose X_WB = MakePose(Vec3(4, -1, 2), RotationFromRpy(0.1, -0.2, 2.0));
  std::vector<double> q_rad(model.joints.size(), 0.0);
  const std::vector<std::pair<const char*, double>> angles = {
      {"slew", 0.7}, {"boom", 0.4}, {"arm", -1.5}, {"bucket", -0.4}};
  std::vector<int> joints;
  for (const auto& [name, angle_rad] : angles) {
    joints.push_back(model.JointIndex(name));
    q_rad[joints.back()] = angle_rad;
  }
  const NamedFrame& tip = model.frames[0];
  const auto tip_in_root = [&](const std::vector<double>& q) {
    return Vec3(X_WB.inverse() *
                (ForwardKinematics(model, X_WB, q)[tip.link] * tip.X_BF.translation()));
  };
  MachineState state;
  state.q_rad = q_rad;
  for (const Pose& X : ForwardKinematics(model, X_WB, q_rad)) {
    state.links.emplace_back();
    state.links.back().X_WB = X;
  }
  const Vec3 start_m = tip_in_root(q_rad);
  const Vec3 way_m(-0.03, 0.05, 0.04);
  const auto rates = ToolRates(model, state, tip, {start_m + way_m, std::nullopt}, joints);
  std::vector<double> moved_rad = q_rad;
  const double dt_s = 1e-4;
  for (std::size_t k = 0; k < joints.size(); ++k) moved_rad[joints[k]] += rates[k] * dt_s;
  const Vec3 v_mps = (tip_in_root(moved_rad) - start_m) / dt_s;
  EXPECT_GT(v_mps.normalized().dot(way_m.normalized()), 0.99);
  // A distant target demands more than the joints can do.
  const auto fast = ToolRates(model, state, tip, {start_m + 50 * way_m, std::nullopt}, joints);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const Joint& joint = model.joints[joints[k]];
    EXPECT_LE(std::abs(fast[k]),
              std::max(joint.max_rate_positive_radps, joint.max_rate_negative_radps) + 1e-12);
  }
}

}  // namespace
}  // namespace tera
