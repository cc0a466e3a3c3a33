#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dataset/ros/messages.h"

namespace tera::ros {

/// ROS 2 quality of service of a topic.
enum class Delivery {
  kSensorData,  ///< best effort, the last 5: usual for sensor drivers
  kLarge,       ///< reliable, the last 2: images and scans, which lose all data with one lost part
  kState,       ///< reliable, the last 10: ROS 2's default
  kTransforms,  ///< reliable, the last 100: /tf
  kLatched,     ///< reliable, the last message, also to late subscribers: /tf_static
  kClock        ///< best effort, the last message
};

/// A participant of a DDS domain, compatible with ROS 2: topics under `rt/`, ROS type names, plain
/// CDR. Only WaitForLevers waits for other participants, with its own limit.
///
/// Model   a reliable writer keeps as many messages as its depth. It drops older messages, received
///         or not.
/// Omits   ROS's discovery topic, so ROS tools show the topics without a node name; parameters,
///         services, actions.
/// Source  ROS 2 design article "Topic and service name mapping to DDS"; rmw_cyclonedds.
class Participant {
 public:
  struct Options {
    int domain_id = 0;
    bool this_host_only = false;  ///< as with ROS_LOCALHOST_ONLY=1
  };
  static constexpr int kLargestDomainId = 232;

  /// CYCLONEDDS_URI overrides its settings. Throws InputError if DDS cannot start, for example
  /// without the network interface or with a bad CYCLONEDDS_URI.
  explicit Participant(const Options& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  using WriterId = int;
  /// `topic` in ROS form, "/excavator1/odom".
  template <typename M>
  WriterId Advertise(const std::string& topic, Delivery delivery) {
    return Advertise(topic, Message(M{}).index(), delivery);
  }
  /// `message` must have the advertised type. A message that cannot be passed on at once is dropped
  /// and counted.
  void Publish(WriterId writer, const Message& message);
  /// True if the topic has a subscriber.
  bool HasReaders(WriterId writer) const;

  using ReaderId = int;
  /// Best effort, which matches publishers of any reliability.
  ReaderId SubscribeToLevers(const std::string& topic);
  /// True if the topic has a publisher.
  bool HasLeverWriters(ReaderId reader) const;
  /// Messages since the last call, oldest first, at most the last 10.
  std::vector<DeltaCan> TakeLevers(ReaderId reader);
  /// Waits until any reader has lever messages. Returns false after `timeout_s`.
  bool WaitForLevers(double timeout_s);

  std::int64_t published() const;
  std::int64_t dropped() const;

 private:
  WriterId Advertise(const std::string& topic, std::size_t message_index, Delivery delivery);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera::ros
