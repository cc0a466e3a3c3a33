#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ros2/live_run.h"

// Levers received over the network.

namespace tera {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(LiveRos, LeversMoveTheMachineTheyAreSentToAndNoOther) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(JointStatesOf("red"));
  peer.Subscribe(JointStatesOf("blue"));
  peer.Advertise(LeversOf("blue"));
  BackgroundRun run({});
  ASSERT_TRUE(peer.WaitForReader("rt/blue/delta_can"));
  const JointView red = JointsOf(Require(peer.Next("rt/red/joint_states"), "red"));
  const JointView blue = JointsOf(Require(peer.Next("rt/blue/joint_states"), "blue"));
  LeverMessage levers;
  levers.boom = 0.5f;
  const auto moved = peer.Next("rt/blue/joint_states", [&](const Payload& payload) {
    peer.Publish("rt/blue/delta_can", levers.Encode());
    return JointsOf(payload).position.at("boom") > blue.position.at("boom") + 0.1;
  });
  const TimeNs then_ns = JointsOf(Require(moved, "the boom rises")).t_ns;
  const auto other = peer.Next("rt/red/joint_states", [&](const Payload& payload) {
    return JointsOf(payload).t_ns >= then_ns;
  });
  EXPECT_NEAR(JointsOf(Require(other, "red")).position.at("boom"), red.position.at("boom"), 0.01);
  EXPECT_GT(run.End().levers_received, 0);
}

TEST(LiveRos, RefusedLeversMoveNothing) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(JointStatesOf("red"));
  peer.Advertise(LeversOf("red"));
  BackgroundRun run({});
  ASSERT_TRUE(peer.WaitForReader("rt/red/delta_can"));
  const JointView before = JointsOf(Require(peer.Next("rt/red/joint_states"), "red"));
  LeverMessage beyond_full, no_number;
  beyond_full.boom = 0.5f;
  beyond_full.slew = 1.5f;
  no_number.boom = 0.5f;
  no_number.arm = NAN;
  int sent = 0;
  const auto later = peer.Next("rt/red/joint_states", [&](const Payload& payload) {
    peer.Publish("rt/red/delta_can", (sent++ % 2 == 0 ? beyond_full : no_number).Encode());
    return JointsOf(payload).t_ns > before.t_ns + kNsPerSecond;
  });
  EXPECT_NEAR(JointsOf(Require(later, "red")).position.at("boom"), before.position.at("boom"),
              0.01);
  const ros::LiveRosReport report = run.End();
  EXPECT_GE(report.levers_refused, 2);
  EXPECT_EQ(report.levers_received, 0);
  EXPECT_THAT(run.log(), Contains(HasSubstr("red: levers refused: slew is 1.5")));
}

TEST(LiveRos, HydraulicLockAndMissingEnableHoldTheMachine) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(JointStatesOf("red"));
  peer.Advertise(LeversOf("red"));
  BackgroundRun run({});
  ASSERT_TRUE(peer.WaitForReader("rt/red/delta_can"));
  JointView before = JointsOf(Require(peer.Next("rt/red/joint_states"), "red"));
  LeverMessage locked, disabled;
  locked.boom = disabled.boom = 0.5f;
  locked.hydraulic_lock = true;
  disabled.enable = false;
  for (const LeverMessage& message : {locked, disabled}) {
    const auto later = peer.Next("rt/red/joint_states", [&](const Payload& payload) {
      peer.Publish("rt/red/delta_can", message.Encode());
      return JointsOf(payload).t_ns > before.t_ns + kNsPerSecond;
    });
    const JointView after = JointsOf(Require(later, "red"));
    EXPECT_NEAR(after.position.at("boom"), before.position.at("boom"), 0.01);
    before = after;
  }
  EXPECT_GT(run.End().levers_received, 0);
}

}  // namespace
}  // namespace tera
