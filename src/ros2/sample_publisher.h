#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "dataset/ros/messages.h"
#include "ros2/participant.h"
#include "sim/scenario/scenario.h"

namespace tera::ros {

/// Publishes sensor measurements on topics named after the machine and sensor.
///
/// Model   A message is published in the step in which its measurement becomes available
///         (t_available). Its stamp is the time of validity. Images and scans without a subscriber
///         are neither rendered nor published. A row sensor without a ROS message type is published
///         as JointState (JointStateOfRow).
/// Omits   ground-truth tables and poses; StatePublisher publishes those for which ROS has
///         messages.
class SamplePublisher : public MeasurementSink {
 public:
  /// Copies what it needs of `scenario`, whose names must be valid in ROS (RequireRosNames). The
  /// participant must outlive the object.
  SamplePublisher(const Scenario& scenario, Participant* participant);

  /// Publishes all messages that are available by `now_ns`.
  void PublishDue(TimeNs now_ns);

  ChannelId AddChannel(const ChannelInfo& info) override;
  void Write(ChannelId channel, Measurement measurement) override;

  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId channel, TimeNs t_ns) override;

 private:
  /// Topics of one sensor by content, such as "image" or "camera_info"; empty for a table.
  struct Channel {
    SensorDescription sensor;
    std::string machine, frame_id;
    std::map<std::string, Participant::WriterId> topics;
    /// For a row sensor: its topic, and the conversion of rows to messages.
    std::string row_topic;
    std::function<Message(const RowSample&)> row_message;
  };
  struct Outgoing {
    Participant::WriterId writer;
    Message message;
  };

  template <typename M>
  void AddTopic(const std::string& below, Delivery delivery, Channel* channel);
  template <typename M, typename MessageOf>
  void AddRowTopic(const std::string& below, const MessageOf& message_of, Channel* channel);
  // Create the topics of a channel, by type. AddRows is for all other types of row sensors.
  void AddImu(const ChannelInfo& info, Channel* channel);
  void AddGnss(const ChannelInfo& info, Channel* channel);
  void AddCamera(const ChannelInfo& info, Channel* channel);
  void AddLidar(const ChannelInfo& info, Channel* channel);
  void AddRows(const ChannelInfo& info, Channel* channel);

  /// Queues `make()` for the time `at_ns` if the topic has a subscriber.
  template <typename Make>
  void Send(const Channel& channel, const std::string& topic, TimeNs at_ns, const Make& make);
  void Write(const Channel& channel, const RowSample& row);
  void Write(const Channel& channel, const CameraFrame& frame);
  void Write(const Channel& channel, const LidarScan& scan);

  Participant* participant_;
  std::map<std::string, SensorDescription> sensors_;  ///< by folder
  std::vector<Channel> channels_;
  std::multimap<TimeNs, Outgoing> outgoing_;  ///< by time of availability
};

}  // namespace tera::ros
