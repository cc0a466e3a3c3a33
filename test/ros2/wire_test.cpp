#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmath>

#include "ros2/cdr.h"
#include "ros2/fast_peer.h"
#include "ros2/participant.h"

// Every message type across the network to another DDS implementation, whose bytes are then read
// field by field in the order of the ROS definitions.

namespace tera {
namespace {

using testing::ElementsAre;

/// The pose with every number different: a turn about no axis of the frame.
Pose WireSkewPose() {
  Pose pose(Eigen::AngleAxisd(1.2, Vec3(1, -2, 2) / 3));
  pose.translation() = Vec3(1.5, -2.25, 3.125);
  return pose;
}

/// cos(0.6) and sin(0.6) (1, -2, 2) / 3, of the half angle.
void ExpectSkewRotation(CdrReader* cdr) {
  EXPECT_NEAR(cdr->F64(), 0.1882141578, 1e-9);
  EXPECT_NEAR(cdr->F64(), -0.3764283156, 1e-9);
  EXPECT_NEAR(cdr->F64(), 0.3764283156, 1e-9);
  EXPECT_NEAR(cdr->F64(), 0.8253356149, 1e-9);
}

void ExpectSkewPose(CdrReader* cdr) {
  EXPECT_EQ(cdr->F64(), 1.5);
  EXPECT_EQ(cdr->F64(), -2.25);
  EXPECT_EQ(cdr->F64(), 3.125);
  ExpectSkewRotation(cdr);
}

constexpr TimeNs kStamp_ns = 7'250'000'003;

[[gnu::noinline]] ros::Header In(const std::string& frame_id) { return {kStamp_ns, frame_id}; }

void ExpectHeader(CdrReader* cdr, const std::string& frame_id) {
  EXPECT_EQ(cdr->I32(), 7);
  EXPECT_EQ(cdr->U32(), 250'000'003u);
  EXPECT_EQ(cdr->Text(), frame_id);
}

class Wire : public testing::Test {
 protected:
  Wire()
      : participant_({.domain_id = OwnDomainId(), .this_host_only = true}), peer_(OwnDomainId()) {}

  /// `message` as the peer receives it, as type `type` on "rt/test/topic".
  template <typename M>
  Payload Across(const std::string& type, const M& message,
                 ros::Delivery delivery = ros::Delivery::kState) {
    const ros::Participant::WriterId writer = participant_.Advertise<M>("/test/topic", delivery);
    peer_.Subscribe({.topic = "rt/test/topic", .type = type, .reliable = true});
    for (int i = 0; i < 6000 && !participant_.HasReaders(writer); ++i) usleep(10'000);
    EXPECT_TRUE(participant_.HasReaders(writer));
    participant_.Publish(writer, message);
    const std::optional<Payload> payload = peer_.Next("rt/test/topic");
    EXPECT_TRUE(payload.has_value()) << type;
    return payload.value_or(Payload{0, 1, 0, 0});
  }

  ros::Participant participant_;
  FastPeer peer_;
};

TEST_F(Wire, Clock) {
  CdrReader cdr(Across("rosgraph_msgs::msg::dds_::Clock_", ros::Clock{kStamp_ns}));
  EXPECT_EQ(cdr.Time(), kStamp_ns);
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, TimeBeforeTheEpochCountsAsItsStart) {
  CdrReader cdr(Across("rosgraph_msgs::msg::dds_::Clock_", ros::Clock{-1}));
  EXPECT_EQ(cdr.Time(), 0);
}

TEST_F(Wire, Float64) {
  CdrReader cdr(Across("std_msgs::msg::dds_::Float64_", ros::Float64{153.25}));
  EXPECT_EQ(cdr.F64(), 153.25);
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, PoseStamped) {
  CdrReader cdr(Across("geometry_msgs::msg::dds_::PoseStamped_",
                       ros::PoseStamped{In("excavator1/undercarriage"), WireSkewPose()}));
  ExpectHeader(&cdr, "excavator1/undercarriage");
  ExpectSkewPose(&cdr);
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, TFMessage) {
  CdrReader cdr(Across(
      "tf2_msgs::msg::dds_::TFMessage_",
      ros::TfMessage{{{In("map"), "a", WireSkewPose()}, {In("a"), "a/child", WireSkewPose()}}}));
  ASSERT_EQ(cdr.U32(), 2u);
  ExpectHeader(&cdr, "map");
  EXPECT_EQ(cdr.Text(), "a");
  ExpectSkewPose(&cdr);
  ExpectHeader(&cdr, "a");
  EXPECT_EQ(cdr.Text(), "a/child");
  ExpectSkewPose(&cdr);
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, Odometry) {
  CdrReader cdr(
      Across("nav_msgs::msg::dds_::Odometry_",
             ros::Odometry{In("map"), "base", WireSkewPose(), Vec3(1, 2, 3), Vec3(4, 5, 6)}));
  ExpectHeader(&cdr, "map");
  EXPECT_EQ(cdr.Text(), "base");
  ExpectSkewPose(&cdr);
  EXPECT_THAT(cdr.Array<36>(), testing::Each(0.0));
  EXPECT_THAT(cdr.Array<6>(), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(cdr.Array<36>(), testing::Each(0.0));
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, JointState) {
  CdrReader cdr(
      Across("sensor_msgs::msg::dds_::JointState_", ros::JointState{In("base"),
                                                                    {"boom", "left_track", "x"},
                                                                    {0.5, 1.5, 2.5},
                                                                    {-0.5, -1.5, -2.5},
                                                                    {1000, 2000, 3000}}));
  ExpectHeader(&cdr, "base");
  EXPECT_THAT(cdr.Get<std::vector<std::string>>(), ElementsAre("boom", "left_track", "x"));
  EXPECT_THAT(cdr.Get<std::vector<double>>(), ElementsAre(0.5, 1.5, 2.5));
  EXPECT_THAT(cdr.Get<std::vector<double>>(), ElementsAre(-0.5, -1.5, -2.5));
  EXPECT_THAT(cdr.Get<std::vector<double>>(), ElementsAre(1000, 2000, 3000));
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, JointStateWithoutEfforts) {
  CdrReader cdr(Across("sensor_msgs::msg::dds_::JointState_",
                       ros::JointState{In("base"), {"boom"}, {0.5}, {-0.5}, {}}));
  ExpectHeader(&cdr, "base");
  EXPECT_THAT(cdr.Get<std::vector<std::string>>(), ElementsAre("boom"));
  EXPECT_THAT(cdr.Get<std::vector<double>>(), ElementsAre(0.5));
  EXPECT_THAT(cdr.Get<std::vector<double>>(), ElementsAre(-0.5));
  EXPECT_THAT(cdr.Get<std::vector<double>>(), ElementsAre());
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, ImuSaysThatItHasNoOrientation) {
  CdrReader cdr(Across("sensor_msgs::msg::dds_::Imu_", ros::Imu{In("imu"),
                                                                Vec3(0.1, 0.2, 0.3),
                                                                Vec3(1, 2, 9.81),
                                                                {1, 2, 3, 4, 5, 6, 7, 8, 9},
                                                                {9, 8, 7, 6, 5, 4, 3, 2, 1}}));
  ExpectHeader(&cdr, "imu");
  EXPECT_THAT(cdr.Array<4>(), ElementsAre(0, 0, 0, 1));
  EXPECT_THAT(cdr.Array<9>(), ElementsAre(-1, 0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(cdr.Array<3>(), ElementsAre(0.1, 0.2, 0.3));
  EXPECT_THAT(cdr.Array<9>(), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(cdr.Array<3>(), ElementsAre(1, 2, 9.81));
  EXPECT_THAT(cdr.Array<9>(), ElementsAre(9, 8, 7, 6, 5, 4, 3, 2, 1));
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, NavSatFix) {
  CdrReader cdr(
      Across("sensor_msgs::msg::dds_::NavSatFix_", ros::NavSatFix{In("gnss"),
                                                                  ros::NavSatFix::kNoFix,
                                                                  47.5,
                                                                  8.25,
                                                                  460.125,
                                                                  {1, 0, 0, 0, 2, 0, 0, 0, 3},
                                                                  ros::NavSatFix::kDiagonalKnown}));
  ExpectHeader(&cdr, "gnss");
  EXPECT_EQ(cdr.Get<std::int8_t>(), -1);
  EXPECT_EQ(cdr.Get<std::uint16_t>(), 1);
  EXPECT_THAT(cdr.Array<3>(), ElementsAre(47.5, 8.25, 460.125));
  EXPECT_THAT(cdr.Array<9>(), ElementsAre(1, 0, 0, 0, 2, 0, 0, 0, 3));
  EXPECT_EQ(cdr.Get<std::uint8_t>(), 2);
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, Image) {
  CdrReader cdr(Across("sensor_msgs::msg::dds_::Image_",
                       ros::Image{In("optical"), 2, 3, "mono8", 3, {1, 2, 3, 4, 5, 255}}));
  ExpectHeader(&cdr, "optical");
  EXPECT_EQ(cdr.U32(), 2u);
  EXPECT_EQ(cdr.U32(), 3u);
  EXPECT_EQ(cdr.Text(), "mono8");
  EXPECT_EQ(cdr.Get<std::uint8_t>(), 0);
  EXPECT_EQ(cdr.U32(), 3u);
  EXPECT_THAT(cdr.Get<std::vector<std::uint8_t>>(), ElementsAre(1, 2, 3, 4, 5, 255));
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, ImageLargerThanADatagram) {
  ros::Image image{In("optical"), 480, 640, "rgb8", 1920, {}};
  for (int i = 0; i < 480 * 1920; ++i) image.data.push_back(static_cast<std::uint8_t>(i * 7 % 251));
  CdrReader cdr(Across("sensor_msgs::msg::dds_::Image_", image));
  ExpectHeader(&cdr, "optical");
  cdr.U32();
  cdr.U32();
  cdr.Text();
  cdr.Get<std::uint8_t>();
  cdr.U32();
  EXPECT_EQ(cdr.Get<std::vector<std::uint8_t>>(), image.data);
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, CameraInfo) {
  CdrReader cdr(Across("sensor_msgs::msg::dds_::CameraInfo_",
                       ros::CameraInfo{In("optical"),
                                       480,
                                       640,
                                       "plumb_bob",
                                       {0.1, 0.2, 0.3, 0.4, 0.5},
                                       {600, 0, 320, 0, 610, 240, 0, 0, 1}}));
  ExpectHeader(&cdr, "optical");
  EXPECT_EQ(cdr.U32(), 480u);
  EXPECT_EQ(cdr.U32(), 640u);
  EXPECT_EQ(cdr.Text(), "plumb_bob");
  EXPECT_THAT(cdr.Get<std::vector<double>>(), ElementsAre(0.1, 0.2, 0.3, 0.4, 0.5));
  EXPECT_THAT(cdr.Array<9>(), ElementsAre(600, 0, 320, 0, 610, 240, 0, 0, 1));
  EXPECT_THAT(cdr.Array<9>(), ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1));
  EXPECT_THAT(cdr.Array<12>(), ElementsAre(600, 0, 320, 0, 0, 610, 240, 0, 0, 0, 1, 0));
  for (int i = 0; i < 6; ++i) EXPECT_EQ(cdr.U32(), 0u) << "binning and region of interest";
  EXPECT_FALSE(cdr.Get<bool>());
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, PointCloud2) {
  ros::PointCloud2 cloud;
  cloud.header = In("lidar");
  cloud.fields = {{"x", 0, ros::PointField::kFloat32}, {"ring", 4, ros::PointField::kUint16}};
  cloud.point_step_bytes = 6;
  cloud.data = {0, 0, 128, 63, 5, 0, 0, 0, 0, 64, 6, 1};
  CdrReader cdr(Across("sensor_msgs::msg::dds_::PointCloud2_", cloud));
  ExpectHeader(&cdr, "lidar");
  EXPECT_EQ(cdr.U32(), 1u);
  EXPECT_EQ(cdr.U32(), 2u);
  ASSERT_EQ(cdr.U32(), 2u);
  EXPECT_EQ(cdr.Text(), "x");
  EXPECT_EQ(cdr.U32(), 0u);
  EXPECT_EQ(cdr.Get<std::uint8_t>(), 7);
  EXPECT_EQ(cdr.U32(), 1u);
  EXPECT_EQ(cdr.Text(), "ring");
  EXPECT_EQ(cdr.U32(), 4u);
  EXPECT_EQ(cdr.Get<std::uint8_t>(), 4);
  EXPECT_EQ(cdr.U32(), 1u);
  EXPECT_FALSE(cdr.Get<bool>());
  EXPECT_EQ(cdr.U32(), 6u);
  EXPECT_EQ(cdr.U32(), 12u);
  EXPECT_EQ(cdr.Get<std::vector<std::uint8_t>>(), cloud.data);
  EXPECT_TRUE(cdr.Get<bool>());
  EXPECT_TRUE(cdr.AtEnd());
}

TEST_F(Wire, LeversComeAsTheyWereSent) {
  const ros::Participant::ReaderId reader = participant_.SubscribeToLevers("/test/delta_can");
  const std::string topic = "rt/test/delta_can";
  peer_.Advertise({.topic = topic, .type = "tera_msgs::msg::dds_::DeltaCAN_", .reliable = true});
  ASSERT_TRUE(peer_.WaitForReader(topic));
  LeverMessage sent{.stamp_sec = 3, .stamp_nanosec = 5, .frame_id = "pilot"};
  sent.slew = 0.125f;
  sent.boom = 0.25f;
  sent.arm = 0.375f;
  sent.bucket = 0.5f;
  sent.left_travel = -0.625f;
  sent.right_travel = -0.75f;
  sent.blade = -0.875f;
  sent.swing = NAN;
  sent.hydraulic_lock = true;
  sent.others = {0.5f, -0.25f};
  std::vector<ros::DeltaCan> come;
  for (int i = 0; i < 600 && come.empty(); ++i) {
    peer_.Publish(topic, sent.Encode());
    if (participant_.WaitForLevers(0.1)) come = participant_.TakeLevers(reader);
  }
  ASSERT_FALSE(come.empty());
  const ros::DeltaCan& m = come[0];
  EXPECT_EQ(m.stamp_sec, 3);
  EXPECT_EQ(m.stamp_nanosec, 5u);
  EXPECT_THAT((std::array{m.slew, m.boom, m.arm, m.bucket, m.left_travel, m.right_travel, m.blade}),
              ElementsAre(0.125f, 0.25f, 0.375f, 0.5f, -0.625f, -0.75f, -0.875f));
  EXPECT_TRUE(std::isnan(m.swing));
  EXPECT_TRUE(m.enable);
  EXPECT_TRUE(m.hydraulic_lock);
  EXPECT_FALSE(m.high_speed);
  EXPECT_THAT(m.others, ElementsAre(0.5f, -0.25f));
}

TEST_F(Wire, CutOffLeversAreNoMessage) {
  const ros::Participant::ReaderId reader = participant_.SubscribeToLevers("/test/delta_can");
  const std::string topic = "rt/test/delta_can";
  peer_.Advertise({.topic = topic, .type = "tera_msgs::msg::dds_::DeltaCAN_", .reliable = true});
  ASSERT_TRUE(peer_.WaitForReader(topic));
  Payload cut_off = LeverMessage{.frame_id = "cut off"}.Encode();
  cut_off.resize(20);
  Payload beyond = LeverMessage{.frame_id = "beyond"}.Encode();
  beyond[12] = 0xff;  // length of the frame's name: more than there is
  std::vector<ros::DeltaCan> come;
  for (int i = 0; i < 600 && come.empty(); ++i) {
    peer_.Publish(topic, cut_off);
    peer_.Publish(topic, beyond);
    peer_.Publish(topic, LeverMessage{.stamp_sec = 9}.Encode());
    if (participant_.WaitForLevers(0.1)) come = participant_.TakeLevers(reader);
  }
  ASSERT_FALSE(come.empty());
  for (const ros::DeltaCan& m : come) EXPECT_EQ(m.stamp_sec, 9);
}

}  // namespace
}  // namespace tera
