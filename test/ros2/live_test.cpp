#include "ros2/live.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <set>
#include <thread>

#include "core/config.h"
#include "ros2/cdr.h"
#include "ros2/fast_peer.h"

// Whole runs of two machines, seen and driven by another DDS implementation on the loopback
// interface. Nothing here asserts how long something takes; waits are far longer than needed.

namespace tera {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr const char* kTwoMachines = R"(
name: two
seed: 5
duration_s: 1
settle_s: 1.5
site: {lat_deg: 47.5, lon_deg: 8.5, height_m: 460}
terrain: {size_m: [20, 20], cell_m: 0.1, soil: dirt}
machines:
  - name: red
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-4, 1], yaw_deg: 30}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3], rate_hz: 100},
      {name: gnss_left, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2]},
      {name: camera, preset: tera:config/sensors/realsense_d435i.yaml, link: upper, xyz_m: [0.8, 0.3, 1.8], rpy_deg: [0, 30, 0], width_px: 64, height_px: 48, rate_hz: 5},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1], columns: 128},
      {name: encoders, preset: tera:config/sensors/encoder.yaml}]}
  - name: blue
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [4, 2], yaw_deg: -100}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu_arm, preset: tera:config/sensors/xsens_mti_670.yaml, link: arm, xyz_m: [0.2, 0, 0.1], rate_hz: 100}]}
)";

/// A run in a thread of its own, ended and waited for at the latest when it goes.
class BackgroundRun {
 public:
  explicit BackgroundRun(ros::LiveRosOptions options) : options_(std::move(options)) {
    options_.dds = {.domain_id = OwnDomainId(), .this_host_only = true};
    options_.stop = [this] { return stop_.load(); };
    options_.log = [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      log_.push_back(line);
    };
    thread_ = std::thread([this] { Run(); });
  }
  ~BackgroundRun() { End(); }

  ros::LiveRosReport End() {
    stop_ = true;
    return Wait();
  }
  ros::LiveRosReport Wait() {
    if (thread_.joinable()) thread_.join();
    return report_;
  }
  std::vector<std::string> log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }

 private:
  void Run() {
    const Config config = Config::FromText(kTwoMachines, "two.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    report_ = ros::RunForRos(std::move(scenario), config.ResolvedYaml(), options_);
  }

  ros::LiveRosOptions options_;
  ros::LiveRosReport report_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::vector<std::string> log_;
  std::thread thread_;
};

/// lever_peer in a process of its own.
class PeerProcess {
 public:
  PeerProcess(const std::string& machine, const std::string& boom) {
    const std::string domain = std::to_string(OwnDomainId());
    pid_ = fork();
    if (pid_ == 0) {
      freopen("/dev/null", "w", stdout);
      execl(LEVER_PEER, LEVER_PEER, domain.c_str(), machine.c_str(), boom.c_str(), nullptr);
      _exit(126);
    }
  }
  ~PeerProcess() { Kill(); }
  /// Without a word to anybody.
  void Kill() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    pid_ = -1;
  }

 private:
  pid_t pid_ = -1;
};

const FastPeer::Wish kClock{.topic = "rt/clock", .type = "rosgraph_msgs::msg::dds_::Clock_"};

FastPeer::Wish JointStatesOf(const std::string& machine) {
  return {.topic = "rt/" + machine + "/joint_states",
          .type = "sensor_msgs::msg::dds_::JointState_",
          .reliable = true};
}

FastPeer::Wish LeversOf(const std::string& machine) {
  return {.topic = "rt/" + machine + "/delta_can",
          .type = "tera_msgs::msg::dds_::DeltaCAN_",
          .reliable = true};
}

TimeNs ClockOf(const Payload& payload) { return CdrReader(payload).Time(); }

struct JointView {
  TimeNs t_ns = 0;
  std::map<std::string, double> position, velocity;
};

JointView JointsOf(const Payload& payload) {
  CdrReader cdr(payload);
  JointView view;
  view.t_ns = cdr.Time();
  cdr.Text();
  const auto names = cdr.Get<std::vector<std::string>>();
  const auto position = cdr.Get<std::vector<double>>(), velocity = cdr.Get<std::vector<double>>();
  EXPECT_EQ(cdr.Get<std::vector<double>>().size(), names.size());
  EXPECT_TRUE(cdr.AtEnd());
  for (std::size_t i = 0; i < names.size(); ++i) {
    view.position[names[i]] = position[i];
    view.velocity[names[i]] = velocity[i];
  }
  return view;
}

/// The payload, or an empty one after a failure.
Payload Require(const std::optional<Payload>& payload, const std::string& what) {
  EXPECT_TRUE(payload.has_value()) << what;
  return payload.value_or(Payload{0, 1, 0, 0});
}

TEST(LiveRos, OffersTheTopicsOfBothMachinesWithRosTypesAndQuality) {
  FastPeer peer(OwnDomainId());
  BackgroundRun run({});
  const OfferedTopic image{"sensor_msgs::msg::dds_::Image_", true, false};
  const OfferedTopic info{"sensor_msgs::msg::dds_::CameraInfo_", true, false};
  const OfferedTopic imu{"sensor_msgs::msg::dds_::Imu_", false, false};
  std::map<std::string, OfferedTopic> expected = {
      {"rt/clock", {"rosgraph_msgs::msg::dds_::Clock_", false, false}},
      {"rt/tf", {"tf2_msgs::msg::dds_::TFMessage_", true, false}},
      {"rt/tf_static", {"tf2_msgs::msg::dds_::TFMessage_", true, true}},
      {"rt/red/imu_boom", imu},
      {"rt/red/gps_left/fix", {"sensor_msgs::msg::dds_::NavSatFix_", false, false}},
      {"rt/red/camera/image_raw", image},
      {"rt/red/camera/camera_info", info},
      {"rt/red/camera/depth/image_raw", image},
      {"rt/red/camera/depth/camera_info", info},
      {"rt/red/camera/semantic/image_raw", image},
      {"rt/red/camera/instance/image_raw", image},
      {"rt/red/lidar/points", {"sensor_msgs::msg::dds_::PointCloud2_", true, false}},
      {"rt/red/encoders", {"sensor_msgs::msg::dds_::JointState_", false, false}},
      {"rt/blue/imu_arm", imu}};
  for (const std::string machine : {"rt/red/", "rt/blue/"}) {
    expected[machine + "odom"] = {"nav_msgs::msg::dds_::Odometry_", true, false};
    expected[machine + "joint_states"] = {"sensor_msgs::msg::dds_::JointState_", true, false};
    expected[machine + "ee_pose"] = {"geometry_msgs::msg::dds_::PoseStamped_", true, false};
    expected[machine + "bucket_mass"] = {"std_msgs::msg::dds_::Float64_", true, false};
  }
  for (const auto& [topic, offer] : expected) EXPECT_EQ(peer.WaitForOffer(topic), offer) << topic;
  EXPECT_EQ(peer.Offers(), expected) << "and no others";
}

TEST(LiveRos, StatesOfTwoMachinesDoNotMix) {
  FastPeer peer(OwnDomainId());
  for (const std::string machine : {"red", "blue"}) {
    peer.Subscribe({.topic = "rt/" + machine + "/odom",
                    .type = "nav_msgs::msg::dds_::Odometry_",
                    .reliable = true});
    peer.Subscribe({.topic = "rt/" + machine + "/ee_pose",
                    .type = "geometry_msgs::msg::dds_::PoseStamped_",
                    .reliable = true});
    peer.Subscribe({.topic = "rt/" + machine + "/bucket_mass",
                    .type = "std_msgs::msg::dds_::Float64_",
                    .reliable = true});
  }
  BackgroundRun run({});
  const std::map<std::string, Vec2> start = {{"red", Vec2(-4, 1)}, {"blue", Vec2(4, 2)}};
  for (const auto& [machine, xy_m] : start) {
    CdrReader odom(Require(peer.Next("rt/" + machine + "/odom"), "odom"));
    EXPECT_GE(odom.Time(), 0);
    EXPECT_EQ(odom.Text(), "map");
    EXPECT_EQ(odom.Text(), machine + "/undercarriage");
    EXPECT_NEAR(odom.F64(), xy_m.x(), 0.05);
    EXPECT_NEAR(odom.F64(), xy_m.y(), 0.05);
    CdrReader pose(Require(peer.Next("rt/" + machine + "/ee_pose"), "ee_pose"));
    pose.Time();
    EXPECT_EQ(pose.Text(), machine + "/undercarriage");
    EXPECT_GT(pose.F64(), 1.5) << "the bucket is before the machine";
    CdrReader mass(Require(peer.Next("rt/" + machine + "/bucket_mass"), "bucket_mass"));
    EXPECT_EQ(mass.F64(), 0.0);
    EXPECT_TRUE(mass.AtEnd());
  }
}

TEST(LiveRos, SensorsMeasure) {
  FastPeer peer(OwnDomainId());
  const auto subscribe = [&](const std::string& topic, const std::string& type) {
    peer.Subscribe({.topic = topic, .type = "sensor_msgs::msg::dds_::" + type + "_"});
  };
  subscribe("rt/red/imu_boom", "Imu");
  subscribe("rt/blue/imu_arm", "Imu");
  subscribe("rt/red/gps_left/fix", "NavSatFix");
  subscribe("rt/red/encoders", "JointState");
  subscribe("rt/red/lidar/points", "PointCloud2");
  for (const std::string below : {"", "depth/", "semantic/", "instance/"}) {
    subscribe("rt/red/camera/" + below + "image_raw", "Image");
  }
  subscribe("rt/red/camera/camera_info", "CameraInfo");
  subscribe("rt/red/camera/depth/camera_info", "CameraInfo");
  BackgroundRun run({});

  for (const auto& [topic, frame] : std::map<std::string, std::string>{
           {"rt/red/imu_boom", "red/imu_boom"}, {"rt/blue/imu_arm", "blue/imu_arm"}}) {
    CdrReader imu(Require(peer.Next(topic), topic));
    imu.Time();
    EXPECT_EQ(imu.Text(), frame);
    imu.Array<4>();
    EXPECT_EQ(imu.Array<9>()[0], -1);
    imu.Array<3>();
    EXPECT_GT(imu.Array<9>()[0], 0);
    const auto f = imu.Array<3>();
    EXPECT_NEAR(std::hypot(f[0], f[1], f[2]), 9.8, 0.5);
    EXPECT_GT(imu.Array<9>()[8], 0);
    EXPECT_TRUE(imu.AtEnd());
  }

  CdrReader fix(Require(peer.Next("rt/red/gps_left/fix"), "fix"));
  fix.Time();
  EXPECT_EQ(fix.Text(), "red/gnss_left");
  EXPECT_EQ(fix.Get<std::int8_t>(), 2);
  fix.Get<std::uint16_t>();
  EXPECT_NEAR(fix.F64(), 47.5, 1e-4);
  EXPECT_NEAR(fix.F64(), 8.5, 1e-4);
  EXPECT_NEAR(fix.F64(), 462, 1);
  EXPECT_GT(fix.Array<9>()[0], 0);
  EXPECT_EQ(fix.Get<std::uint8_t>(), 2);
  EXPECT_TRUE(fix.AtEnd());

  CdrReader encoders(Require(peer.Next("rt/red/encoders"), "encoders"));
  encoders.Time();
  encoders.Text();
  EXPECT_THAT(encoders.Get<std::vector<std::string>>(), Contains("boom"));

  const std::map<std::string, std::pair<std::string, int>> images = {{"", {"rgb8", 3}},
                                                                     {"depth/", {"32FC1", 4}},
                                                                     {"semantic/", {"mono8", 1}},
                                                                     {"instance/", {"mono16", 2}}};
  for (const auto& [below, form] : images) {
    CdrReader image(Require(peer.Next("rt/red/camera/" + below + "image_raw"), below));
    image.Time();
    EXPECT_EQ(image.Text(), "red/camera_optical");
    EXPECT_EQ(image.U32(), 48u);
    EXPECT_EQ(image.U32(), 64u);
    EXPECT_EQ(image.Text(), form.first);
    image.Get<std::uint8_t>();
    EXPECT_EQ(image.U32(), 64u * form.second);
    const auto data = image.Get<std::vector<std::uint8_t>>();
    EXPECT_EQ(data.size(), 48u * 64 * form.second);
    EXPECT_GT(std::set<std::uint8_t>(data.begin(), data.end()).size(), 1u) << "a picture";
    EXPECT_TRUE(image.AtEnd());
  }
  for (const std::string below : {"", "depth/"}) {
    CdrReader info(Require(peer.Next("rt/red/camera/" + below + "camera_info"), below));
    info.Time();
    EXPECT_EQ(info.Text(), "red/camera_optical");
    EXPECT_EQ(info.U32(), 48u);
    EXPECT_EQ(info.U32(), 64u);
    EXPECT_EQ(info.Text(), "plumb_bob");
    EXPECT_EQ(info.Get<std::vector<double>>().size(), 5u);
    // realsense_d435i.yaml: 54.5 degrees across the width.
    EXPECT_NEAR(info.Array<9>()[0], 32 / std::tan(54.5 / 2 * M_PI / 180), 0.01);
  }

  CdrReader cloud(Require(peer.Next("rt/red/lidar/points"), "points"));
  cloud.Time();
  EXPECT_EQ(cloud.Text(), "red/lidar");
  EXPECT_EQ(cloud.U32(), 1u);
  const std::uint32_t points = cloud.U32();
  EXPECT_GT(points, 100u);
  std::vector<std::string> fields;
  for (std::uint32_t n = cloud.U32(); n > 0; --n) {
    fields.push_back(cloud.Text());
    cloud.U32();
    cloud.Get<std::uint8_t>();
    cloud.U32();
  }
  EXPECT_THAT(fields, IsSupersetOf({"x", "y", "z", "intensity", "ring", "time", "label"}));
  cloud.Get<bool>();
  const std::uint32_t step = cloud.U32();
  EXPECT_EQ(cloud.U32(), points * step);
  EXPECT_EQ(cloud.Get<std::vector<std::uint8_t>>().size(), points * step);
  EXPECT_TRUE(cloud.Get<bool>());
  EXPECT_TRUE(cloud.AtEnd());
}

TEST(LiveRos, LateSubscriberGetsEveryUnmovingTransform) {
  BackgroundRun run({});
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  for (int i = 0; i < 20; ++i) Require(peer.Next("rt/clock"), "clock");
  peer.Subscribe({.topic = "rt/tf_static",
                  .type = "tf2_msgs::msg::dds_::TFMessage_",
                  .reliable = true,
                  .transient_local = true});
  CdrReader cdr(Require(peer.Next("rt/tf_static"), "tf_static"));
  std::set<std::string> frames;
  for (std::uint32_t n = cdr.U32(); n > 0; --n) {
    cdr.Time();
    cdr.Text();
    frames.insert(cdr.Text());
    cdr.Array<7>();
  }
  EXPECT_EQ(frames, (std::set<std::string>{"red/imu_boom", "red/gnss_left", "red/camera",
                                           "red/camera_optical", "red/lidar", "blue/imu_arm"}));
  peer.Subscribe({.topic = "rt/tf", .type = "tf2_msgs::msg::dds_::TFMessage_", .reliable = true});
  CdrReader moving(Require(peer.Next("rt/tf"), "tf"));
  EXPECT_EQ(moving.U32(), 14u) << "two roots and six joints each";
}

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

TEST(LiveRos, LockstepGoesOnWithEachAnswerAndNotWithout) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  peer.Advertise(LeversOf("red"));
  BackgroundRun run({.pace = ros::Pace::kLockstep, .rate_hz = 50, .answer_timeout_s = 600});
  ASSERT_TRUE(peer.WaitForReader("rt/red/delta_can"));
  TimeNs now_ns = ClockOf(Require(peer.Next("rt/clock"), "clock"));
  for (int tick = 0; tick < 30; ++tick) {
    if (tick == 10) {  // no answer: the same time again and again
      for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(ClockOf(Require(peer.Next("rt/clock"), "repeated clock")), now_ns);
      }
    }
    if (tick == 20) {  // an answer to another time is none
      LeverMessage stale{.stamp_sec = 1000};
      peer.Publish("rt/red/delta_can", stale.Encode());
      for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(ClockOf(Require(peer.Next("rt/clock"), "repeated clock")), now_ns);
      }
    }
    const auto next = peer.Next("rt/clock", [&](const Payload& payload) {
      const LeverMessage answer{.stamp_sec = static_cast<std::int32_t>(now_ns / kNsPerSecond),
                                .stamp_nanosec = static_cast<std::uint32_t>(now_ns % kNsPerSecond)};
      peer.Publish("rt/red/delta_can", answer.Encode());
      return ClockOf(payload) != now_ns;
    });
    const TimeNs next_ns = ClockOf(Require(next, "next clock"));
    EXPECT_EQ(next_ns, now_ns + 20'000'000);
    now_ns = next_ns;
  }
  EXPECT_EQ(run.End().timeouts, 0);
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

TEST(LiveRos, PeerThatIsKilledInLockstepIsGivenUpAndItsMachineComesToRest) {
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  peer.Subscribe(JointStatesOf("red"));
  BackgroundRun run({.pace = ros::Pace::kLockstep, .answer_timeout_s = 2});
  PeerProcess pilot("red", "0.4");
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
  EXPECT_EQ(run.End().timeouts, 1);
  EXPECT_THAT(run.log(), Contains(HasSubstr("red: no levers for /clock")));
}

TEST(LiveRos, SubscriberThatIsKilledStopsNothing) {
  BackgroundRun run({});
  FastPeer peer(OwnDomainId());
  peer.Subscribe(kClock);
  {
    PeerProcess listener("blue", "0");
    for (int i = 0; i < 50; ++i) Require(peer.Next("rt/clock"), "clock");
  }
  const TimeNs then_ns = ClockOf(Require(peer.Next("rt/clock"), "clock"));
  EXPECT_TRUE(peer.Next("rt/clock", [&](const Payload& payload) {
    return ClockOf(payload) > then_ns + kNsPerSecond;
  }));
  EXPECT_EQ(run.End().dropped, 0);
}

}  // namespace
}  // namespace tera
