#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dataset/ros/messages.h"

namespace tera::ros {

/// Quality of service (QoS) of a topic.
enum class Delivery {
  kSensorData,  ///< best effort, last 5 messages; common for sensor drivers
  kLarge,  ///< reliable, last 2 messages; for images and scans, which are lost if one fragment is
           ///< lost
  kState,  ///< reliable, last 10 messages; default of ROS 2
  kTransforms,  ///< reliable, last 100 messages; for /tf
  kLatched,     ///< reliable, last message, which late subscribers also receive; for /tf_static
  kClock        ///< best effort, last message
};

/// A DDS participant compatible with ROS 2: topic names begin with `rt/`, types have ROS names,
/// encoding is plain CDR. Only WaitForLevers waits for other participants, and only up to its
/// timeout.
///
/// Model   A reliable writer keeps as many messages as its history depth. Older messages are
///         dropped even if a reader has not received them.
/// Omits   ROS node discovery, so ROS tools show topics without a node name; parameters, services
///         and actions.
/// Source  ROS 2 design article "Topic and service name mapping to DDS"; rmw_cyclonedds.
class Participant {
 public:
  struct Options {
    int domain_id = 0;
    bool this_host_only = false;  ///< as ROS_LOCALHOST_ONLY=1
  };
  static constexpr int kLargestDomainId = 232;

  /// The environment variable CYCLONEDDS_URI overrides the settings. Throws InputError if DDS
  /// cannot start, for example without the network interface or with an invalid CYCLONEDDS_URI.
  explicit Participant(const Options& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  using WriterId = int;
  /// `topic` is the ROS name, such as "/excavator1/odom".
  template <typename M>
  WriterId Advertise(const std::string& topic, Delivery delivery) {
    return Advertise(topic, Message(M{}).index(), delivery);
  }
  /// The type of `message` must be the advertised type. A message that cannot be sent at once is
  /// dropped and counted.
  void Publish(WriterId writer, const Message& message);
  bool HasReaders(WriterId writer) const;

  using ReaderId = int;
  /// The subscription is best effort, so it matches publishers of any reliability.
  ReaderId SubscribeToLevers(const std::string& topic);
  bool HasLeverWriters(ReaderId reader) const;
  /// Messages since the last call, oldest first, at most the last 10.
  std::vector<DeltaCan> TakeLevers(ReaderId reader);
  /// Waits until any subscription has a message. Returns false at the timeout.
  bool WaitForLevers(double timeout_s);

  std::int64_t published() const;
  std::int64_t dropped() const;

 private:
  WriterId Advertise(const std::string& topic, std::size_t message_index, Delivery delivery);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera::ros
