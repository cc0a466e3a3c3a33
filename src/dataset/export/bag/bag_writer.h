#pragma once

#include <string>
#include <string_view>

#include "core/time.h"
#include "dataset/ros/serializer.h"

namespace tera {

/// Quality of service of a topic. The history keeps the last `depth` messages.
struct TopicQuality {
  int depth = 10;
  bool reliable = true;
  bool latched = false;  ///< also delivered to late subscribers
};

struct Topic {
  std::string name;       ///< "/excavator1/odom"
  std::string_view type;  ///< "nav_msgs/Odometry"
  TopicQuality quality;
};

/// Writes a bag of ROS messages. All topics are added before the first message; messages come in
/// order of time.
class BagWriter {
 public:
  virtual ~BagWriter() = default;

  virtual ros::WireForm form() const = 0;
  /// Returns the topic's number, the first argument of Write.
  virtual std::size_t AddTopic(const Topic& topic) = 0;
  /// `t_ns` is at least 0.
  virtual void Write(std::size_t topic, TimeNs t_ns, std::string_view message) = 0;
  virtual void Finish() = 0;
};

}  // namespace tera
