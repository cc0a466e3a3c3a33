#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "ros2/live_run.h"

// How simulated time goes by.

namespace tera {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(LiveRos, LockstepGoesOnWithEachAnswerAndNotWithout) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  peer.Advertise(LeversOf("red"));
  BackgroundRun run({.pace = ros::Pace::kLockstep, .rate_hz = 50, .answer_timeout_s = 600});
  ASSERT_TRUE(peer.WaitForReader("rt/red/delta_can"));
  TimeNs now_ns = ClockOf(Require(peer.Next("rt/clock"), "clock"));
  for (int tick = 0; tick < 30; ++tick) {
    if (tick == 10) {  // no reply: the same time is repeated
      for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(ClockOf(Require(peer.Next("rt/clock"), "repeated clock")), now_ns);
      }
    }
    if (tick == 20) {  // a reply to another time does not count
      LeverMessage stale{.stamp_sec = 1000};
      peer.Publish("rt/red/delta_can", stale.Encode());
      for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(ClockOf(Require(peer.Next("rt/clock"), "repeated clock")), now_ns);
      }
    }
    const auto next = peer.Next("rt/clock", [&](const Payload& payload) {
      peer.Publish("rt/red/delta_can", AnswerTo(now_ns).Encode());
      return ClockOf(payload) != now_ns;
    });
    const TimeNs next_ns = ClockOf(Require(next, "next clock"));
    EXPECT_EQ(next_ns, now_ns + 20'000'000);
    now_ns = next_ns;
  }
  EXPECT_EQ(run.End().timeouts, 0);
}

TEST(LiveRos, LockstepObeysTheFirstAnswerToThePresentTimeAndNoOtherMessage) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  peer.Subscribe(JointStatesOf("red"));
  peer.Advertise(LeversOf("red"));
  BackgroundRun run({.pace = ros::Pace::kLockstep, .rate_hz = 50, .answer_timeout_s = 600});
  ASSERT_TRUE(peer.WaitForReader("rt/red/delta_can"));
  TimeNs now_ns = ClockOf(Require(peer.Next("rt/clock"), "clock"));
  for (int tick = 0; tick < 50; ++tick) {
    LeverMessage early = AnswerTo(now_ns + 10 * kNsPerSecond), late = AnswerTo(now_ns - 20'000'000),
                 second = AnswerTo(now_ns);
    early.boom = late.boom = second.boom = 1;
    const auto next = peer.Next("rt/clock", [&](const Payload& payload) {
      if (now_ns > 0) peer.Publish("rt/red/delta_can", late.Encode());
      for (const LeverMessage& message : {early, AnswerTo(now_ns), second}) {
        peer.Publish("rt/red/delta_can", message.Encode());
      }
      return ClockOf(payload) != now_ns;
    });
    now_ns = ClockOf(Require(next, "next clock"));
  }
  const JointView start = JointsOf(Require(peer.Next("rt/red/joint_states"), "first"));
  const auto end = peer.Next("rt/red/joint_states", [&](const Payload& payload) {
    return JointsOf(payload).t_ns >= now_ns;
  });
  EXPECT_NEAR(JointsOf(Require(end, "red")).position.at("boom"), start.position.at("boom"), 0.01);
  const ros::LiveRosReport report = run.End();
  EXPECT_GE(report.levers_unasked, 2 * 49);
  EXPECT_GE(report.levers_received, report.levers_unasked + 50);
  EXPECT_EQ(report.levers_refused, 0);
  EXPECT_EQ(report.timeouts, 0);
  EXPECT_THAT(run.log(), Contains(HasSubstr("red: levers stamped 10.000000000 s not taken")));
}

TEST(LiveRos, LockstepAnswersDrive) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  peer.Subscribe(JointStatesOf("red"));
  peer.Advertise(LeversOf("red"));
  BackgroundRun run({.pace = ros::Pace::kLockstep, .rate_hz = 50, .answer_timeout_s = 600});
  ASSERT_TRUE(peer.WaitForReader("rt/red/delta_can"));
  const auto second = peer.Next("rt/clock", [&](const Payload& payload) {
    LeverMessage answer = AnswerTo(ClockOf(payload));
    answer.boom = 0.5f;
    peer.Publish("rt/red/delta_can", answer.Encode());
    return ClockOf(payload) >= kNsPerSecond;
  });
  const TimeNs second_ns = ClockOf(Require(second, "a second"));
  const JointView start = JointsOf(Require(peer.Next("rt/red/joint_states"), "first"));
  const auto end = peer.Next("rt/red/joint_states", [&](const Payload& payload) {
    return JointsOf(payload).t_ns >= second_ns;
  });
  EXPECT_GT(JointsOf(Require(end, "red")).position.at("boom"), start.position.at("boom") + 0.1);
}

TEST(LiveRos, LockstepWithoutAnyPeerEndsByItself) {
  BackgroundRun run({.pace = ros::Pace::kLockstep, .answer_timeout_s = 0.1, .duration_s = 0.2});
  EXPECT_NEAR(run.Wait().simulated_s, 0.2, 1e-9);
  EXPECT_THAT(run.log(), Contains(HasSubstr("nobody has published levers")));
}

TEST(LiveRos, EveryPaceEndsAtItsDurationWithNobodyThere) {
  for (const ros::Pace pace : {ros::Pace::kReal, ros::Pace::kFast}) {
    BackgroundRun run({.pace = pace, .duration_s = 0.5});
    const ros::LiveRosReport report = run.Wait();
    EXPECT_NEAR(report.simulated_s, 0.5, 1e-9);
    EXPECT_GT(report.published, 100);
    EXPECT_EQ(report.dropped, 0);
  }
}

TEST(LiveRos, RealPaceWaitsBeforeEachTickUntilTheWallIsThere) {
  // A wall clock that advances only while somebody waits for it.
  const ros::Wall::Moment start = ros::Wall::Moment() + std::chrono::seconds(1000);
  ros::Wall::Moment now = start;
  std::vector<ros::Wall::Moment> waited;
  const ros::Wall wall = {.now = [&] { return now; },
                          .sleep_until =
                              [&](ros::Wall::Moment moment) {
                                waited.push_back(moment);
                                now = moment;
                              }};
  BackgroundRun run({.pace = ros::Pace::kReal, .duration_s = 2, .wall = wall});
  EXPECT_NEAR(run.Wait().simulated_s, 2, 1e-9);
  // 100 ticks a second; none after the last of the run.
  ASSERT_EQ(waited.size(), 200u);
  for (std::size_t tick = 0; tick < waited.size(); ++tick) {
    EXPECT_EQ(waited[tick], start + tick * std::chrono::milliseconds(10));
  }
}

TEST(LiveRos, DurationThatIsNoWholeNumberOfTicksEndsWithItsStepOfThePhysics) {
  // Steps of 2 ms, ticks of 10 ms.
  for (const double duration_s : {0.006, 0.034, 0.07}) {
    BackgroundRun run({.pace = ros::Pace::kFast, .duration_s = duration_s});
    EXPECT_NEAR(run.Wait().simulated_s, duration_s, 1e-9);
  }
}

}  // namespace
}  // namespace tera
