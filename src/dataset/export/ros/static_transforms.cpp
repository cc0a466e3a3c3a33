#include "dataset/export/ros/static_transforms.h"

#include <algorithm>
#include <filesystem>
#include <string>

#include "core/units.h"
#include "dataset/export/record_views.h"
#include "dataset/format/events_table.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/ros/names.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

/// Rotation X_SC of the optical frame C in the sensor frame S: z of C is x of S, and x of C is -y
/// of S.
Pose OpticalInSensor() { return MakePose(Vec3::Zero(), -90 * kDeg, 0, -90 * kDeg); }

}  // namespace

std::vector<ros::TransformStamped> StaticTransforms(ExportJob* job) {
  std::vector<ros::TransformStamped> transforms;
  const TimeNs t_ns = job->Stamp(0);
  for (const JointTree& tree : job->JointTrees()) {
    const std::string pose_file = "truth/" + tree.machine + "/pose.csv";
    if (tree.fixed_base && job->recording.Has(pose_file)) {
      RecordStream poses(job->recording, std::vector<std::string>{pose_file});
      if (Record record; poses.Next(&record)) {
        transforms.push_back({{t_ns, ros::kWorldFrame},
                              ros::FrameOf(tree.machine, tree.root),
                              PoseOf(poses, record).X_WB});
      }
    }
    for (const JointTree::Joint& joint : tree.joints) {
      if (joint.motion != JointTree::Motion::kNone) continue;
      transforms.push_back({{t_ns, ros::FrameOf(tree.machine, joint.parent)},
                            ros::FrameOf(tree.machine, joint.child),
                            joint.X_PJ});
    }
  }
  const std::vector<std::string> cameras = job->recording.SensorsOf(ChannelForm::kPictures);
  for (const ChannelDescription& channel : job->recording.channels()) {
    if (channel.type == kPoseChannel || channel.type == kTableChannel) continue;
    if (channel.type == kEventsChannel) continue;
    const SensorSheet sheet = ReadSensorSheet(job->recording.directory() / channel.path);
    const std::string machine = MachineOf(channel.path);
    const std::string name = fs::path(channel.path).filename();
    const std::string frame_id = ros::FrameOf(machine, name);
    if (sheet.X_PS && !sheet.parent_link.empty()) {
      transforms.push_back(
          {{t_ns, ros::FrameOf(machine, sheet.parent_link)}, frame_id, *sheet.X_PS});
    }
    if (std::find(cameras.begin(), cameras.end(), channel.path) != cameras.end()) {
      transforms.push_back(
          {{t_ns, frame_id}, ros::OpticalFrameOf(machine, name), OpticalInSensor()});
    }
  }
  return transforms;
}

}  // namespace tera
