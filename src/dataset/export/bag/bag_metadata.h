#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dataset/export/bag/bag_writer.h"

namespace tera {

/// Summary of a rosbag2 bag for its metadata.yaml.
struct BagMetadata {
  struct CountedTopic {
    Topic topic;
    std::int64_t messages = 0;
  };
  std::string storage;  ///< "mcap" or "sqlite3"
  std::string file;     ///< file name within the folder of the bag
  TimeNs first_ns = 0, last_ns = 0;
  std::int64_t messages = 0;
  std::vector<CountedTopic> topics;

  /// Counts a message of the topic at `t_ns`.
  void Count(std::size_t topic, TimeNs t_ns);
};

/// Text of metadata.yaml version 5, the version of ROS 2 Humble. Later releases read it too.
std::string MetadataYaml(const BagMetadata& bag);

/// YAML list with the QoS profile of a topic. Enumerators are numbers of rmw.
std::string QosProfiles(const TopicQuality& quality);

}  // namespace tera
