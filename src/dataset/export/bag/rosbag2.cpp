#include <string>

#include "dataset/export/bag/bag_metadata.h"
#include "dataset/export/bag/mcap_writer.h"
#include "dataset/export/bag/sqlite_bag_writer.h"
#include "dataset/export/export_job.h"
#include "dataset/export/ros/ros_topics.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace {

/// Writes all messages and returns the summary of the bag.
BagMetadata WriteMessages(ExportJob* job, BagWriter* bag) {
  RosTopics topics(job, bag);
  BagMetadata metadata;
  for (const Topic& topic : topics.topics()) metadata.topics.push_back({topic});
  topics.OnWrite([&](std::size_t topic, TimeNs t_ns) { metadata.Count(topic, t_ns); });
  topics.WriteAll();
  return metadata;
}

}  // namespace

/// Writes a ROS 2 bag: NAME_0.mcap or NAME_0.db3, with metadata.yaml.
void ExportRosbag2(ExportJob* job) {
  const bool mcap = job->options.storage == BagStorage::kMcap;
  const std::string file = job->name + "_0." + (mcap ? "mcap" : "db3");
  BagMetadata metadata;
  if (mcap) {
    McapWriter bag(job->folder / file, job->options.compression, job->options.threads);
    metadata = WriteMessages(job, &bag);
    bag.Finish();
  } else {
    SqliteBagWriter bag(job->folder / file);
    metadata = WriteMessages(job, &bag);
    metadata.storage = "sqlite3";
    metadata.file = file;
    bag.AddMetadata(MetadataYaml(metadata));
    bag.Finish();
  }
  metadata.storage = mcap ? "mcap" : "sqlite3";
  metadata.file = file;
  WriteWholeFile(job->folder / "metadata.yaml", MetadataYaml(metadata));
}

}  // namespace tera
