#include "dataset/export/bag/ros1_bag_writer.h"
#include "dataset/export/export_job.h"
#include "dataset/export/ros/ros_topics.h"

namespace tera {

/// Writes a ROS 1 bag: NAME.bag.
void ExportBag(ExportJob* job) {
  Ros1BagWriter bag(job->folder / (job->name + ".bag"));
  RosTopics(job, &bag).WriteAll();
  bag.Finish();
}

}  // namespace tera
