#include "dataset/export/bag/bag_metadata.h"

#include <fmt/format.h>

#include <algorithm>

#include "dataset/format/dataset_description.h"
#include "dataset/ros/message_definitions.h"

namespace tera {

void BagMetadata::Count(std::size_t topic, TimeNs t_ns) {
  first_ns = messages == 0 ? t_ns : std::min(first_ns, t_ns);
  last_ns = messages == 0 ? t_ns : std::max(last_ns, t_ns);
  ++messages;
  ++topics.at(topic).messages;
}

std::string QosProfiles(const TopicQuality& quality) {
  constexpr int kKeepLast = 1, kReliable = 1, kBestEffort = 2, kTransientLocal = 1, kVolatile = 2;
  constexpr int kAutomatic = 1;
  // An infinite duration in the notation of rmw.
  constexpr const char* kForever = "\n    sec: 9223372036\n    nsec: 854775807\n";
  return fmt::format(
      "- history: {}\n  depth: {}\n  reliability: {}\n  durability: {}\n  deadline:{}"
      "  lifespan:{}  liveliness: {}\n  liveliness_lease_duration:{}"
      "  avoid_ros_namespace_conventions: false",
      kKeepLast, quality.depth, quality.reliable ? kReliable : kBestEffort,
      quality.latched ? kTransientLocal : kVolatile, kForever, kForever, kAutomatic, kForever);
}

std::string MetadataYaml(const BagMetadata& bag) {
  const TimeNs duration_ns = bag.last_ns - bag.first_ns;
  std::string yaml = fmt::format(
      "rosbag2_bagfile_information:\n"
      "  version: 5\n"
      "  storage_identifier: {}\n"
      "  duration:\n    nanoseconds: {}\n"
      "  starting_time:\n    nanoseconds_since_epoch: {}\n"
      "  message_count: {}\n"
      "  topics_with_message_count:\n",
      bag.storage, duration_ns, bag.first_ns, bag.messages);
  for (const BagMetadata::CountedTopic& counted : bag.topics) {
    yaml += fmt::format(
        "    - topic_metadata:\n"
        "        name: {}\n"
        "        type: {}\n"
        "        serialization_format: cdr\n"
        "        offered_qos_profiles: {}\n"
        "      message_count: {}\n",
        counted.topic.name, ros::FullTypeName(counted.topic.type, ros::WireForm::kCdr),
        YamlQuoted(QosProfiles(counted.topic.quality)), counted.messages);
  }
  yaml += fmt::format(
      "  compression_format: \"\"\n"
      "  compression_mode: \"\"\n"
      "  relative_file_paths:\n    - {0}\n"
      "  files:\n"
      "    - path: {0}\n"
      "      starting_time:\n        nanoseconds_since_epoch: {1}\n"
      "      duration:\n        nanoseconds: {2}\n"
      "      message_count: {3}\n",
      YamlQuoted(bag.file), bag.first_ns, duration_ns, bag.messages);
  return yaml;
}

}  // namespace tera
