#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dataset/ros/messages.h"

namespace tera::ros {

/// How a topic is delivered: ROS 2's quality of service for it.
enum class Delivery {
  kSensorData,  ///< best effort, the last 5: what sensor drivers offer
  kLarge,       ///< reliable, the last 2: pictures and scans, of which one lost part loses all
  kState,       ///< reliable, the last 10: ROS 2's default
  kTransforms,  ///< reliable, the last 100: /tf
  kLatched,     ///< reliable, the last one, also to who comes later: /tf_static
  kClock        ///< best effort, the last one
};

/// One participant of a DDS domain as ROS 2 sees it: topics under `rt/`, ROS's type names, plain
/// CDR. None of its calls waits for another participant but WaitForLevers, which has its own limit.
///
/// Model   A reliable writer keeps the last messages of its depth and gives up older ones, whether
///         they have been received or not.
/// Omits   ROS's own discovery topic, so that its tools show the topics without a node's name;
///         parameters, services, actions.
/// Source  ROS 2 design article "Topic and service name mapping to DDS"; rmw_cyclonedds.
class Participant {
 public:
  struct Options {
    int domain_id = 0;
    bool this_host_only = false;  ///< as with ROS_LOCALHOST_ONLY=1
  };
  static constexpr int kLargestDomainId = 232;

  /// Reads CYCLONEDDS_URI over its own settings. Throws InputError where DDS cannot start: no such
  /// network interface, a bad CYCLONEDDS_URI.
  explicit Participant(const Options& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  using WriterId = int;
  /// `topic` as ROS writes it, "/excavator1/odom".
  template <typename M>
  WriterId Advertise(const std::string& topic, Delivery delivery) {
    return Advertise(topic, Message(M{}).index(), delivery);
  }
  /// `message` must be of the type that the topic was advertised with. One that cannot be handed
  /// over at once is dropped and counted.
  void Publish(WriterId writer, const Message& message);
  /// Whether anybody has asked for the topic.
  bool HasReaders(WriterId writer) const;

  using ReaderId = int;
  /// Best effort, so that publishers of any reliability fit.
  ReaderId SubscribeToLevers(const std::string& topic);
  /// Whether anybody publishes to it.
  bool HasLeverWriters(ReaderId reader) const;
  /// What has come since the last call, oldest first, at most the last 10.
  std::vector<DeltaCan> TakeLevers(ReaderId reader);
  /// Waits until lever messages of any reader are waiting. False after `timeout_s`.
  bool WaitForLevers(double timeout_s);

  std::int64_t published() const;
  std::int64_t dropped() const;

 private:
  WriterId Advertise(const std::string& topic, std::size_t message_index, Delivery delivery);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera::ros
