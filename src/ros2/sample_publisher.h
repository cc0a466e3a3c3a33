#pragma once

#include <map>
#include <string>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "ros2/messages.h"
#include "ros2/participant.h"
#include "sim/scenario/scenario.h"

namespace tera::ros {

/// What the sensors of a run measure, as ROS topics below each machine's name.
///
/// Model   a message goes out in the step in which its measurement becomes available (t_available);
///         its stamp is the time at which it was valid. Pictures and scans that nobody has asked
///         for are neither measured nor sent.
/// Omits   tables and poses of the truth: StatePublisher has what ROS knows of them.
class SamplePublisher : public MeasurementSink {
 public:
  /// Copies what it needs of `scenario`, whose names must be ROS's (RequireRosNames). The
  /// participant must outlive it.
  SamplePublisher(const Scenario& scenario, Participant* participant);

  /// Sends what has become available by `now_ns`.
  void PublishDue(TimeNs now_ns);

  ChannelId AddImu(const std::string& folder, const std::string& sensor_yaml) override;
  ChannelId AddGnss(const std::string& folder, const std::string& sensor_yaml) override;
  ChannelId AddEncoder(const std::string& folder, const std::string& sensor_yaml,
                       const std::vector<EncoderAxis>& axes) override;
  ChannelId AddCamera(const std::string& folder, const std::string& sensor_yaml) override;
  ChannelId AddLidar(const std::string& folder, const std::string& sensor_yaml) override;
  ChannelId AddTable(const std::string& file, const std::vector<std::string>& columns) override;
  ChannelId AddPose(const std::string& file, bool with_velocity) override;

  void Write(ChannelId channel, const ImuSample& sample) override;
  void Write(ChannelId channel, const GnssSample& sample) override;
  void Write(ChannelId channel, const EncoderSample& sample) override;
  void Write(ChannelId channel, CameraFrame frame) override;
  void Write(ChannelId channel, LidarScan scan) override;
  void Write(ChannelId channel, const TruthPose& pose) override;
  void WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values) override;

  bool NeedsFrame(ChannelId channel, TimeNs t_ns, TimeNs next_ns) const override;
  void MarkPresent(ChannelId channel, TimeNs t_ns) override;

 private:
  /// Topics of one sensor, by what they carry ("image", "camera_info"); none for a table.
  struct Channel {
    SensorDescription sensor;
    std::string frame_id;
    std::vector<std::string> axes;  ///< of an encoder
    std::map<std::string, Participant::WriterId> topics;
  };
  struct Outgoing {
    Participant::WriterId writer;
    Message message;
  };

  Channel ChannelOf(const std::string& folder) const;
  template <typename M>
  void AddTopic(const std::string& folder, const std::string& below, Delivery delivery,
                Channel* channel);
  ChannelId Add(Channel channel);
  /// Sends `make()` at `at_ns` where somebody listens to the channel's topic.
  template <typename Make>
  void Send(const Channel& channel, const std::string& topic, TimeNs at_ns, const Make& make);

  Participant* participant_;
  std::map<std::string, SensorDescription> sensors_;  ///< by folder
  std::vector<Channel> channels_;
  std::multimap<TimeNs, Outgoing> outgoing_;  ///< by the time at which they become available
};

}  // namespace tera::ros
