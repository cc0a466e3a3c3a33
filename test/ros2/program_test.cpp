#include "app/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>

#include "ros2/cdr.h"
#include "ros2/fast_peer.h"

// `tera ros2` from a user's view.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Ros2Command : public testing::Test {
 protected:
  Ros2Command() { WriteWholeFile(path() / "small.yaml", SmallScenario(kCamera)); }

  const fs::path& path() const { return scratch_.path(); }

  /// On this process' own domain and only on this host, by the environment.
  Surroundings Here() const {
    return {path(),
            {{"ROS_DOMAIN_ID", std::to_string(OwnDomainId())}, {"ROS_LOCALHOST_ONLY", "1"}}};
  }

  static Arguments Ros2(const Arguments& more) {
    Arguments arguments = {"ros2", "small.yaml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

 private:
  ScratchDirectory scratch_;
};

TEST_F(Ros2Command, SaysOnWhichDomainItIsAndWhatItDid) {
  const Outcome outcome = RunTera(Ros2({"--pace", "fast", "--duration", "0.2"}), Here());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("small for ROS 2 on domain " +
                                           std::to_string(OwnDomainId()) + ", this host only"),
                                 HasSubstr("0.2 s simulated"), HasSubstr("0 dropped")));
}

TEST_F(Ros2Command, OptionsGoBeforeTheEnvironment) {
  Surroundings here = Here();
  here.environment["ROS_DOMAIN_ID"] = "no number";
  const std::string domain = std::to_string(OwnDomainId());
  const Outcome outcome =
      RunTera(Ros2({"--domain", domain, "--pace", "fast", "--duration", "0.1"}), here);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("on domain " + domain));
}

TEST_F(Ros2Command, BadInputIsStatus2AndNamesIt) {
  const auto expect = [&](const Arguments& more, const Surroundings& here, const char* text) {
    Arguments arguments = Ros2(more);
    arguments.insert(arguments.end(), {"--pace", "fast", "--duration", "0.1"});
    const Outcome outcome = RunTera(arguments, here);
    EXPECT_EQ(outcome.status, 2) << text;
    EXPECT_EQ(outcome.out, "") << text;  // nothing has begun
    EXPECT_THAT(outcome.err, HasSubstr(text));
  };
  for (const std::string id : {"x", "-1", "233", "7 "}) {
    Surroundings here = Here();
    here.environment["ROS_DOMAIN_ID"] = id;
    expect({}, here, "ROS_DOMAIN_ID");
  }
  Surroundings elsewhere = Here();
  elsewhere.environment["ROS_LOCALHOST_ONLY"] = "0";
  elsewhere.environment["CYCLONEDDS_URI"] =
      "<General><Interfaces><NetworkInterface name=\"none0\"/></Interfaces></General>";
  expect({}, elsewhere, "DDS cannot start");
  expect({"--rate", "600"}, Here(), "physics_rate_hz");
  expect({"--set", "machines[0].name=rover-1"}, Here(), "rover-1");
  expect({"--domain", "233"}, Here(), "--domain");
  expect({"--pace", "slow"}, Here(), "--pace");
  expect({"--answer-timeout", "0"}, Here(), "--answer-timeout");
}

TEST_F(Ros2Command, DrivenRunIsRecordedUntilItIsStoppedAndReplayedToTheSameBytes) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe({.topic = "rt/rover1/odom", .type = "nav_msgs::msg::dds_::Odometry_"});
  peer.Advertise({.topic = "rt/rover1/delta_can",
                  .type = "tera_msgs::msg::dds_::DeltaCAN_",
                  .reliable = true});
  TeraProcess run(Ros2({"--record", "driven"}), Here());
  LeverMessage levers;
  levers.left_travel = levers.right_travel = 0.6f;
  const auto arrived = peer.Next("rt/rover1/odom", [&](const Payload& payload) {
    peer.Publish("rt/rover1/delta_can", levers.Encode());
    CdrReader odom(payload);
    odom.Time();
    odom.Text();
    odom.Text();
    const auto p_W = odom.Array<3>();
    return std::hypot(p_W[0], p_W[1]) > 0.3;
  });
  EXPECT_TRUE(arrived.has_value()) << "the rover drives";
  EXPECT_TRUE(run.Running());
  run.Signal(SIGINT);
  const Outcome outcome = run.Wait();
  EXPECT_EQ(outcome.status, 0) << outcome.err;

  const Outcome replay = RunTera({"replay", "driven", "--out", "again"}, {path()});
  EXPECT_EQ(replay.status, 0) << replay.err;
  const auto driven = AllFiles(path() / "driven"), again = AllFiles(path() / "again");
  EXPECT_GT(driven.size(), 5u);
  EXPECT_EQ(driven.size(), again.size());
  for (const auto& [file, bytes] : driven) {
    ASSERT_TRUE(again.contains(file)) << file;
    EXPECT_TRUE(again.at(file) == bytes) << file;
  }
}

}  // namespace
}  // namespace tera
