#pragma once

#include <string>
#include <string_view>

#include "core/time.h"
#include "dataset/ros/serializer.h"

namespace tera {

/// Quality of service (QoS) of a topic. The history keeps the last `depth` messages.
struct TopicQuality {
  int depth = 10;
  bool reliable = true;
  bool latched = false;  ///< a late subscriber receives the last messages
};

struct Topic {
  std::string name;       ///< "/excavator1/odom"
  std::string_view type;  ///< "nav_msgs/Odometry"
  TopicQuality quality;
};

/// Writes ROS messages to a bag. All topics are added before the first message. Messages are
/// written in order of time.
class BagWriter {
 public:
  virtual ~BagWriter() = default;

  virtual ros::WireForm form() const = 0;
  /// Returns the topic's number for Write.
  virtual std::size_t AddTopic(const Topic& topic) = 0;
  /// `t_ns` must not be negative.
  virtual void Write(std::size_t topic, TimeNs t_ns, std::string_view message) = 0;
  virtual void Finish() = 0;
};

}  // namespace tera
