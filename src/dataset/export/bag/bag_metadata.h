#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dataset/export/bag/bag_writer.h"

namespace tera {

/// Contents of a rosbag2 bag, for its metadata.yaml.
struct BagMetadata {
  struct CountedTopic {
    Topic topic;
    std::int64_t messages = 0;
  };
  std::string storage;  ///< "mcap" or "sqlite3"
  std::string file;     ///< in the bag's folder
  TimeNs first_ns = 0, last_ns = 0;
  std::int64_t messages = 0;
  std::vector<CountedTopic> topics;

  /// Counts a message of a topic.
  void Count(std::size_t topic, TimeNs t_ns);
};

/// The text of metadata.yaml, version 5, which ROS 2 Humble writes and later versions read.
std::string MetadataYaml(const BagMetadata& bag);

/// A topic's list of one profile in a bag (rmw's numbers).
std::string QosProfiles(const TopicQuality& quality);

}  // namespace tera
