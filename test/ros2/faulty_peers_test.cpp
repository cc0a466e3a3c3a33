#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>

#include "ros2/live_run.h"

// Peers that die, hang, or lose packets do not block anything.

namespace tera {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(LiveRos, PeerThatIsKilledInLockstepIsGivenUpAndItsMachineComesToRest) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  peer.Subscribe(JointStatesOf("red"));
  BackgroundRun run({.pace = ros::Pace::kLockstep, .answer_timeout_s = 2});
  PeerProcess pilot(LeverPeer("red", "0.4"));
  const auto raised = peer.Next("rt/red/joint_states", [&](const Payload& payload) {
    return JointsOf(payload).velocity.at("boom") > 0.05;
  });
  const TimeNs alive_ns = JointsOf(Require(raised, "the boom rises")).t_ns;
  pilot.Kill();
  const auto rest = peer.Next("rt/red/joint_states", [&](const Payload& payload) {
    const JointView joints = JointsOf(payload);
    return joints.t_ns > alive_ns + 2 * kNsPerSecond &&
           std::abs(joints.velocity.at("boom")) < 0.005;
  });
  EXPECT_TRUE(rest.has_value());
  EXPECT_GE(run.End().timeouts, 1) << "on a busy machine there may be more";
  EXPECT_THAT(run.log(), Contains(HasSubstr("red: no levers for /clock")));
}

TEST(LiveRos, SubscriberThatIsKilledStopsNothing) {
  BackgroundRun run({});
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  {
    PeerProcess listener(LeverPeer("blue", "0"));
    for (int i = 0; i < 50; ++i) Require(peer.Next("rt/clock"), "clock");
  }
  const TimeNs then_ns = ClockOf(Require(peer.Next("rt/clock"), "clock"));
  EXPECT_TRUE(peer.Next("rt/clock", [&](const Payload& payload) {
    return ClockOf(payload) > then_ns + kNsPerSecond;
  }));
  EXPECT_EQ(run.End().dropped, 0);
}

TEST(LiveRos, PeerThatHangsInLockstepIsGivenUpAndObeyedAgainOnceItAnswersAgain) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  peer.Subscribe(JointStatesOf("red"));
  BackgroundRun run({.pace = ros::Pace::kLockstep, .answer_timeout_s = 2});
  PeerProcess pilot(LeverPeer("red", "0.4"));
  const auto rises = [&](const Payload& payload) {
    return JointsOf(payload).velocity.at("boom") > 0.05;
  };
  ASSERT_TRUE(peer.Next("rt/red/joint_states", rises));
  pilot.Signal(SIGSTOP);
  const auto rest = peer.Next("rt/red/joint_states", [&](const Payload& payload) {
    return std::ranges::any_of(run.log(),
                               [](const std::string& line) {
                                 return line.starts_with("red: no levers for /clock");
                               }) &&
           std::abs(JointsOf(payload).velocity.at("boom")) < 0.005;
  });
  ASSERT_TRUE(rest.has_value());
  pilot.Signal(SIGCONT);
  EXPECT_TRUE(peer.Next("rt/red/joint_states", rises));
  EXPECT_GE(run.End().timeouts, 1);
}

TEST(LiveRos, ReliableReaderThatHangsStopsNothing) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  BackgroundRun run({.pace = ros::Pace::kFast});
  PeerProcess reader(HungReader(
      {JointStatesOf("red"),
       {.topic = "rt/tf", .type = "tf2_msgs::msg::dds_::TFMessage_"},
       {.topic = "rt/red/camera/image_raw", .type = "sensor_msgs::msg::dds_::Image_"},
       {.topic = "rt/red/lidar/points", .type = "sensor_msgs::msg::dds_::PointCloud2_"}}));
  const auto stopped = peer.Next("rt/clock", [&](const Payload&) { return reader.IsStopped(); });
  const TimeNs then_ns = ClockOf(Require(stopped, "clock"));
  const auto later = peer.Next("rt/clock", [&](const Payload& payload) {
    return ClockOf(payload) > then_ns + 5 * kNsPerSecond;
  });
  EXPECT_TRUE(later.has_value());
  const ros::LiveRosReport report = run.End();
  EXPECT_GT(report.simulated_s, ToSeconds(then_ns) + 5);
  EXPECT_EQ(report.dropped, 0);
}

/// While it lives, starting participants of Cyclone DDS lose this many packets of a thousand.
class Lossy {
 public:
  explicit Lossy(int per_mille) {
    const std::string loss = std::to_string(per_mille);
    setenv(
        "CYCLONEDDS_URI",
        ("<Internal><Test><XmitLossiness>" + loss + "</XmitLossiness></Test></Internal>").c_str(),
        1);
  }
  ~Lossy() { unsetenv("CYCLONEDDS_URI"); }
};

TEST(LiveRos, ReliableTopicsArriveOverALossyNetwork) {
  const Lossy network(200);
  FastPeer peer(OwnDomainId());
  peer.Subscribe(JointStatesOf("red"));
  peer.Subscribe({.topic = "rt/red/lidar/points",
                  .type = "sensor_msgs::msg::dds_::PointCloud2_",
                  .reliable = true});
  peer.Subscribe({.topic = "rt/tf_static",
                  .type = "tf2_msgs::msg::dds_::TFMessage_",
                  .reliable = true,
                  .transient_local = true});
  BackgroundRun run({});
  EXPECT_TRUE(peer.Next("rt/tf_static").has_value());
  EXPECT_TRUE(peer.Next("rt/red/lidar/points").has_value());
  const JointView first = JointsOf(Require(peer.Next("rt/red/joint_states"), "red"));
  EXPECT_TRUE(peer.Next("rt/red/joint_states", [&](const Payload& payload) {
    return JointsOf(payload).t_ns > first.t_ns + 2 * kNsPerSecond;
  }));
  EXPECT_EQ(run.End().dropped, 0);
}

TEST(LiveRos, LockstepGoesOnOverALossyNetwork) {
  const Lossy network(300);
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  peer.Advertise(LeversOf("red"));
  BackgroundRun run({.pace = ros::Pace::kLockstep, .rate_hz = 50, .answer_timeout_s = 600});
  TimeNs last_ns = -1;
  const auto end = peer.Next("rt/clock", [&](const Payload& payload) {
    const TimeNs now_ns = ClockOf(payload);
    if (last_ns >= 0 && now_ns != last_ns) {
      EXPECT_EQ(now_ns, last_ns + 20'000'000) << "no tick goes by unanswered";
    }
    last_ns = now_ns;
    peer.Publish("rt/red/delta_can", AnswerTo(now_ns).Encode());
    return now_ns >= kNsPerSecond;
  });
  EXPECT_TRUE(end.has_value());
  EXPECT_EQ(run.End().timeouts, 0);
}

}  // namespace
}  // namespace tera
