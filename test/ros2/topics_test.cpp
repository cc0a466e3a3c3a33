#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "ros2/live_run.h"

// Topics and messages of a run.

namespace tera {
namespace {

using testing::Contains;
using testing::IsSupersetOf;

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
    expected[machine + "cylinders"] = {"sensor_msgs::msg::dds_::JointState_", true, false};
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

}  // namespace
}  // namespace tera
