#pragma once

#include <string>
#include <string_view>

#include "core/time.h"
#include "dataset/ros/serializer.h"

namespace tera {

/// How a topic was offered: history, reliability and durability as ROS 2 numbers them.
struct TopicQuality {
  int depth = 10;
  bool reliable = true;
  bool latched = false;  ///< also to who comes later
};

struct Topic {
  std::string name;       ///< "/excavator1/odom"
  std::string_view type;  ///< "nav_msgs/Odometry"
  TopicQuality quality;
};

/// A bag of ROS messages that is being written. Topics come before the first message, messages in
/// order of time.
class BagWriter {
 public:
  virtual ~BagWriter() = default;

  virtual ros::WireForm form() const = 0;
  /// The number that Write takes.
  virtual std::size_t AddTopic(const Topic& topic) = 0;
  /// `t_ns` from 0.
  virtual void Write(std::size_t topic, TimeNs t_ns, std::string_view message) = 0;
  virtual void Finish() = 0;
};

}  // namespace tera
