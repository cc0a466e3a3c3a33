#include <dds/dds.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "ros2/cdr.h"
#include "ros2/fast_peer.h"
#include "ros2/participant.h"
#include "ros2/peer_process.h"

// Quality of service that a participant offers for its topics, and its compliance.

namespace tera {
namespace {

class Quality : public testing::Test {
 protected:
  Quality()
      : participant_({.domain_id = OwnDomainId(), .this_host_only = true}), peer_(OwnDomainId()) {}

  ros::Participant participant_;
  FastPeer peer_;
};

TEST_F(Quality, LatecomerGetsTheLastOfALatchedTopic) {
  const auto writer = participant_.Advertise<ros::TfMessage>("/tf_static", ros::Delivery::kLatched);
  participant_.Publish(writer,
                       ros::TfMessage{{{ros::Header{0, "map"}, "first", Pose::Identity()}}});
  participant_.Publish(writer, ros::TfMessage{{{ros::Header{0, "map"}, "last", Pose::Identity()}}});
  peer_.Subscribe({.topic = "rt/tf_static",
                   .type = "tf2_msgs::msg::dds_::TFMessage_",
                   .reliable = true,
                   .transient_local = true});
  const std::optional<Payload> payload = peer_.Next("rt/tf_static");
  ASSERT_TRUE(payload.has_value());
  CdrReader cdr(*payload);
  EXPECT_EQ(cdr.U32(), 1u);
  cdr.Time();
  EXPECT_EQ(cdr.Text(), "map");
  EXPECT_EQ(cdr.Text(), "last");
}

TEST_F(Quality, OffersTheQualityOfServiceThatRosHas) {
  participant_.Advertise<ros::Imu>("/sensor", ros::Delivery::kSensorData);
  participant_.Advertise<ros::Image>("/picture", ros::Delivery::kLarge);
  participant_.Advertise<ros::Odometry>("/state", ros::Delivery::kState);
  participant_.Advertise<ros::TfMessage>("/tf", ros::Delivery::kTransforms);
  participant_.Advertise<ros::TfMessage>("/tf_static", ros::Delivery::kLatched);
  participant_.Advertise<ros::Clock>("/clock", ros::Delivery::kClock);
  EXPECT_EQ(peer_.WaitForOffer("rt/sensor"),
            (OfferedTopic{"sensor_msgs::msg::dds_::Imu_", false, false}));
  EXPECT_EQ(peer_.WaitForOffer("rt/picture"),
            (OfferedTopic{"sensor_msgs::msg::dds_::Image_", true, false}));
  EXPECT_EQ(peer_.WaitForOffer("rt/state"),
            (OfferedTopic{"nav_msgs::msg::dds_::Odometry_", true, false}));
  EXPECT_EQ(peer_.WaitForOffer("rt/tf"),
            (OfferedTopic{"tf2_msgs::msg::dds_::TFMessage_", true, false}));
  EXPECT_EQ(peer_.WaitForOffer("rt/tf_static"),
            (OfferedTopic{"tf2_msgs::msg::dds_::TFMessage_", true, true}));
  EXPECT_EQ(peer_.WaitForOffer("rt/clock"),
            (OfferedTopic{"rosgraph_msgs::msg::dds_::Clock_", false, false}));
}

/// Number of messages that each writer keeps, by topic, as discovered.
std::map<std::string, int> OfferedDepths(int domain_id) {
  const dds_entity_t participant =
      dds_create_participant(static_cast<dds_domainid_t>(domain_id), nullptr, nullptr);
  const dds_entity_t reader =
      dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
  void* samples[32] = {};
  dds_sample_info_t infos[32];
  const dds_return_t count = dds_take(reader, samples, infos, 32, 32);
  std::map<std::string, int> depths;
  for (int i = 0; i < count; ++i) {
    const auto& writer = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
    dds_history_kind_t kind = DDS_HISTORY_KEEP_ALL;
    std::int32_t depth = -1;
    EXPECT_TRUE(dds_qget_history(writer.qos, &kind, &depth)) << writer.topic_name;
    EXPECT_EQ(kind, DDS_HISTORY_KEEP_LAST) << writer.topic_name;
    depths[writer.topic_name] = depth;
  }
  dds_return_loan(reader, samples, count);
  dds_delete(participant);
  return depths;
}

TEST_F(Quality, WritersKeepAsManyMessagesAsIsDocumented) {
  participant_.Advertise<ros::Imu>("/sensor", ros::Delivery::kSensorData);
  participant_.Advertise<ros::Image>("/picture", ros::Delivery::kLarge);
  participant_.Advertise<ros::Odometry>("/state", ros::Delivery::kState);
  participant_.Advertise<ros::TfMessage>("/tf", ros::Delivery::kTransforms);
  participant_.Advertise<ros::TfMessage>("/tf_static", ros::Delivery::kLatched);
  participant_.Advertise<ros::Clock>("/clock", ros::Delivery::kClock);
  EXPECT_EQ(OfferedDepths(OwnDomainId()), (std::map<std::string, int>{{"rt/sensor", 5},
                                                                      {"rt/picture", 2},
                                                                      {"rt/state", 10},
                                                                      {"rt/tf", 100},
                                                                      {"rt/tf_static", 1},
                                                                      {"rt/clock", 1}}));
}

TEST_F(Quality, ReliableReaderThatHangsHoldsNeitherTheWriterNorOtherReaders) {
  const auto writer = participant_.Advertise<ros::Image>("/picture", ros::Delivery::kLarge);
  const FastPeer::Wish wish{
      .topic = "rt/picture", .type = "sensor_msgs::msg::dds_::Image_", .reliable = true};
  peer_.Subscribe(wish);
  ros::Image image;
  image.header.frame_id = "optical";
  image.height_px = 480;
  image.width_px = 640;
  image.encoding = "rgb8";
  image.step_bytes = 1920;
  image.data.resize(480 * 1920);
  PeerProcess reader(HungReader({wish}));
  std::int64_t written = 0;
  const auto write = [&] {
    image.header.t_ns = written++;
    participant_.Publish(writer, image);
    usleep(20'000);
  };
  for (int i = 0; i < 3000 && !reader.IsStopped(); ++i) write();
  ASSERT_TRUE(reader.IsStopped());
  for (int i = 0; i < 100; ++i) write();  // 92 MB that the hung reader does not acknowledge
  EXPECT_EQ(participant_.published(), written);
  EXPECT_EQ(participant_.dropped(), 0);
  EXPECT_TRUE(peer_.Next("rt/picture", [&](const Payload& payload) {
    return CdrReader(payload).Time() == written - 1;
  })) << "the last picture, to the reader that does read";
}

}  // namespace
}  // namespace tera
