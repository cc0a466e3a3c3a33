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

// Qualities of service in docs/reference/ros2.md.
inline constexpr TopicQuality kSensorData = {5, false, false};
inline constexpr TopicQuality kLarge = {2, true, false};
inline constexpr TopicQuality kState = {10, true, false};
inline constexpr TopicQuality kManyTransforms = {100, true, false};
inline constexpr TopicQuality kLatched = {1, true, true};
inline constexpr TopicQuality kLatest = {1, false, false};

/// Writes a recording as the ROS topics and frames of docs/reference/ros2.md to a bag.
///
/// Model   a message is written at the time of its availability; its stamp is the time of validity.
///         Times below 0 are sent as 0, since ROS has none.
class RosTopics {
 public:
  /// Keeps references. Throws InputError if two topics have the same name.
  RosTopics(ExportJob* job, BagWriter* bag);

  /// All messages in order of time.
  void WriteAll();
  const std::vector<Topic>& topics() const { return topics_; }
  /// Sets a callback for each written message.
  void OnWrite(std::function<void(std::size_t topic, TimeNs t_ns)> told) {
    told_ = std::move(told);
  }

 private:
  /// Consumer of a channel's records.
  using Take = std::function<void(const Record&)>;
  using TopicId = std::size_t;
  /// A serialised message.
  struct WireMessage {
    TopicId topic = 0;
    TimeNs t_ns = 0;
    std::string bytes;
  };

  /// Topic of a kind of picture.
  struct PictureTopic {
    std::string kind;
    TopicId topic = 0;
    const LabelChannel* label = nullptr;  ///< null for rgb and depth
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
  /// Queues a message after all earlier ones.
  template <typename Message>
  void Write(TopicId topic, TimeNs t_ns, const Message& message) {
    messages_->GiveResult({Wire(topic, t_ns, message)});
  }
  /// Messages of a camera's frame. Runs on any thread.
  std::vector<WireMessage> CompressedPictures(const std::string& path, const Record& record,
                                              const std::vector<PictureTopic>& pictures,
                                              const std::string& frame_id) const;
  std::vector<WireMessage> RawPictures(const std::string& path, const Record& record,
                                       const std::vector<PictureTopic>& pictures,
                                       const std::string& frame_id) const;
  /// Writes to the bag.
  void Put(const std::vector<WireMessage>& messages);
  void AddTake(const std::string& path, Take take);
  /// Any row, by its column names.
  Take JointStateTake(const std::string& topic, const std::string& frame_id,
                      const TopicQuality& quality);
  /// A pose in the world.
  Take PoseTake(const std::string& topic);
  std::vector<std::string> ColumnsOf(const std::string& path) const;
  bool IsMachine(const std::string& body) const;
  std::string RootFrameOf(const std::string& machine) const;
  /// Writes clock and ground up to a time, in order.
  void WriteClockUntil(TimeNs t_ns);
  void WriteGroundUntil(TimeNs t_ns);

  ExportJob* job_;
  BagWriter* bag_;
  std::vector<Topic> topics_;
  std::set<std::string> names_;
  std::vector<StreamedChannel> channels_;
  std::map<std::string, std::vector<Take>> takes_;  ///< by channel
  std::unique_ptr<RecordStream> stream_;            ///< set while writing
  /// Pending messages in order. Frames are decoded in parallel.
  std::unique_ptr<InOrder<std::vector<WireMessage>>> messages_;
  TopicId clock_, transforms_, static_transforms_, ground_ = 0;
  std::deque<GroundSnapshot> snapshots_;  ///< pending snapshots
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
