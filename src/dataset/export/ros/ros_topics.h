#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/types/label_channels.h"
#include "dataset/export/bag/bag_writer.h"
#include "dataset/export/export_job.h"
#include "dataset/export/record_stream.h"
#include "dataset/export/ros/ground_snapshots.h"
#include "dataset/export/ros/joint_tree.h"
#include "dataset/files/in_order.h"
#include "dataset/ros/messages.h"
#include "dataset/ros/names.h"
#include "dataset/ros/serializer.h"

namespace tera {

// QoS profiles of docs/reference/ros2.md: depth, reliable, latched.
inline constexpr TopicQuality kSensorData = {5, false, false};
inline constexpr TopicQuality kLarge = {2, true, false};
inline constexpr TopicQuality kState = {10, true, false};
inline constexpr TopicQuality kManyTransforms = {100, true, false};
inline constexpr TopicQuality kLatched = {1, true, true};
inline constexpr TopicQuality kLatest = {1, false, false};

/// Writes a recording to a bag as the topics and frames of docs/reference/ros2.md.
///
/// Model   The bag time of a message is t_available_ns; the stamp in its header is t_ns. Negative
///         times become 0, because ROS has no negative times.
class RosTopics {
 public:
  /// Keeps references to both arguments. Throws InputError if two topics have the same name.
  RosTopics(ExportJob* job, BagWriter* bag);

  void WriteAll();
  const std::vector<Topic>& topics() const { return topics_; }
  /// Sets a function that is called after each written message.
  void OnWrite(std::function<void(std::size_t topic, TimeNs t_ns)> told) {
    told_ = std::move(told);
  }

 private:
  /// Processes a record of one channel.
  using Take = std::function<void(const Record&)>;
  using TopicId = std::size_t;
  struct WireMessage {
    TopicId topic = 0;
    TimeNs t_ns = 0;
    std::string bytes;
  };

  /// Topic of one kind of image of a camera.
  struct PictureTopic {
    std::string kind;
    TopicId topic = 0;
    const LabelChannel* label = nullptr;  ///< null for colour and depth
  };

  void AddChannels();
  void AddSensor(const std::string& path);
  void AddRows(const std::string& path);
  void AddCamera(const std::string& path);
  void AddLidar(const std::string& path);
  void AddPose(const std::string& path);
  void AddTable(const std::string& path);
  void AddJoints(const std::string& path);
  void AddMovingJoints(const std::string& path, const std::vector<std::string>& columns);
  void AddCylinders(const std::string& path);
  void AddTool(const std::string& path, const std::vector<std::string>& columns);
  void AddLevers(const std::string& path);

  template <typename Message>
  TopicId AddTopic(const std::string& name, const TopicQuality& quality);
  template <typename Message>
  WireMessage Wire(TopicId topic, TimeNs t_ns, const Message& message) const;
  /// Appends a message after all messages queued before.
  template <typename Message>
  void Write(TopicId topic, TimeNs t_ns, const Message& message) {
    messages_->GiveResult({Wire(topic, t_ns, message)});
  }
  /// Messages for one frame of a camera. Thread-safe.
  std::vector<WireMessage> CompressedPictures(const std::string& path, const Record& record,
                                              const std::vector<PictureTopic>& pictures,
                                              const std::string& frame_id) const;
  std::vector<WireMessage> RawPictures(const std::string& path, const Record& record,
                                       const std::vector<PictureTopic>& pictures,
                                       const std::string& frame_id) const;
  void Put(const std::vector<WireMessage>& messages);
  void AddTake(const std::string& path, Take take);
  /// Publishes any row as a JointState, with the column names as joint names.
  Take JointStateTake(const std::string& topic, const std::string& frame_id,
                      const TopicQuality& quality);
  /// Publishes poses in the world frame.
  Take PoseTake(const std::string& topic);
  std::vector<std::string> ColumnsOf(const std::string& path) const;
  bool IsMachine(const std::string& body) const;
  std::string RootFrameOf(const std::string& machine) const;
  /// Write the clock ticks and ground maps that are due at `t_ns` or before.
  void WriteClockUntil(TimeNs t_ns);
  void WriteGroundUntil(TimeNs t_ns);

  ExportJob* job_;
  BagWriter* bag_;
  std::vector<Topic> topics_;
  std::set<std::string> names_;
  std::vector<StreamedChannel> channels_;
  std::map<std::string, std::vector<Take>> takes_;  ///< by channel path
  std::unique_ptr<RecordStream> stream_;            ///< set while writing
  /// Queued messages in order. Frames are decoded on worker threads.
  std::unique_ptr<InOrder<std::vector<WireMessage>>> messages_;
  TopicId clock_, transforms_, static_transforms_, ground_ = 0;
  std::deque<GroundSnapshot> snapshots_;  ///< ground maps not yet written
  std::int64_t next_tick_ = 0;
  std::function<void(std::size_t, TimeNs)> told_;
};

template <typename Message>
RosTopics::TopicId RosTopics::AddTopic(const std::string& name, const TopicQuality& quality) {
  const Topic topic = {ros::AllowedName(name), Message::kType, quality};
  if (!names_.insert(topic.name).second) {
    throw InputError(
        job_->recording.directory().string(),
        {FaultKind::kRepeated,
         fmt::format("two channels would be the ROS topic {}; rename one of them in the recording",
                     topic.name)});
  }
  topics_.push_back(topic);
  return bag_->AddTopic(topic);
}

template <typename Message>
RosTopics::WireMessage RosTopics::Wire(TopicId topic, TimeNs t_ns, const Message& message) const {
  ros::Serializer serializer(bag_->form());
  serializer.Put(message);
  return {topic, std::max<TimeNs>(0, t_ns), serializer.TakeBytes()};
}

}  // namespace tera
