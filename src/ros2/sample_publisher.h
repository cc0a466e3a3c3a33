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

/// What the sensors of a run measure, as ROS topics below each machine's name.
///
/// Model   a message goes out in the step in which its measurement becomes available (t_available);
///         its stamp is the time at which it was valid. Pictures and scans that nobody has asked
///         for are neither measured nor sent.
///         A sensor whose samples are rows, of a kind without a message of its own, is a
///         JointState of its columns (JointStateOfRow).
/// Omits   tables and poses of the truth: StatePublisher has what ROS knows of them.
class SamplePublisher : public MeasurementSink {
 public:
  /// Copies what it needs of `scenario`, whose names must be ROS's (RequireRosNames). The
  /// participant must outlive it.
  SamplePublisher(const Scenario& scenario, Participant* participant);

  /// Sends what has become available by `now_ns`.
  void PublishDue(TimeNs now_ns);

  ChannelId AddChannel(const ChannelInfo& info) override;
  void Write(ChannelId channel, Measurement measurement) override;

  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId channel, TimeNs t_ns) override;

 private:
  /// Topics of one sensor, by what they carry ("image", "camera_info"); none for a table.
  struct Channel {
    SensorDescription sensor;
    std::string machine, frame_id;
    std::map<std::string, Participant::WriterId> topics;
    /// For a sensor whose samples are rows, the topic and the message of a row.
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
  // How the topics of one type of channel are added; those of any other type of rows are the last.
  void AddImu(const ChannelInfo& info, Channel* channel);
  void AddGnss(const ChannelInfo& info, Channel* channel);
  void AddCamera(const ChannelInfo& info, Channel* channel);
  void AddLidar(const ChannelInfo& info, Channel* channel);
  void AddRows(const ChannelInfo& info, Channel* channel);

  /// Sends `make()` at `at_ns` where somebody listens to the channel's topic.
  template <typename Make>
  void Send(const Channel& channel, const std::string& topic, TimeNs at_ns, const Make& make);
  void Write(const Channel& channel, const RowSample& row);
  void Write(const Channel& channel, const CameraFrame& frame);
  void Write(const Channel& channel, const LidarScan& scan);

  Participant* participant_;
  std::map<std::string, SensorDescription> sensors_;  ///< by folder
  std::vector<Channel> channels_;
  std::multimap<TimeNs, Outgoing> outgoing_;  ///< by the time at which they become available
};

}  // namespace tera::ros
