#include <algorithm>
#include <utility>

#include "dataset/export/link_path.h"
#include "dataset/export/ros/joint_table.h"
#include "dataset/export/ros/ros_topics.h"
#include "dataset/ros/delta_can.h"
#include "dataset/ros/names.h"

// Messages from tables of a machine: joints, cylinders, tool and levers.

namespace tera {

void RosTopics::AddJoints(const std::string& path) {
  const std::string machine = MachineOf(path), frame_id = RootFrameOf(machine);
  const std::vector<std::string> columns = ColumnsOf(path);
  std::vector<JointColumns> groups = JointColumnsOf(columns, "_rad", "_radps", "_nm");
  for (JointColumns& group : JointColumnsOf(columns, "_m", "_mps", "_n"))
    groups.push_back(std::move(group));
  std::sort(groups.begin(), groups.end(),
            [](const JointColumns& a, const JointColumns& b) { return a.position < b.position; });
  const TopicId id = AddTopic<ros::JointState>(ros::TopicOf(machine, "joint_states"), kState);
  AddTake(path, [=, this](const Record& record) {
    Write(id, job_->Stamp(record.t_available_ns),
          JointStateOf(groups, record, frame_id, job_->Stamp(record.t_ns)));
  });
  AddMovingJoints(path, columns);
  AddTool(path, columns);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    constexpr std::string_view kMass = "_soil_kg", kVolume = "_soil_m3";
    if (!columns[c].ends_with(kMass)) continue;
    if (!ColumnOf(columns, WithoutEnding(columns[c], kMass) + std::string(kVolume))) continue;
    const TopicId mass = AddTopic<ros::Float64>(ros::TopicOf(machine, "bucket_mass"), kState);
    AddTake(path, [=, this](const Record& record) {
      Write(mass, job_->Stamp(record.t_available_ns), ros::Float64{record.values[c]});
    });
    break;  // only the first shovel, as in the live ROS 2 interface
  }
}

void RosTopics::AddMovingJoints(const std::string& path, const std::vector<std::string>& columns) {
  const JointTree* const tree = job_->JointTreeOf(MachineOf(path));
  if (tree == nullptr) return;
  struct MovingJoint {
    JointTree::Joint joint;
    std::size_t column;
  };
  std::vector<MovingJoint> joints;
  for (const JointTree::Joint& joint : tree->joints) {
    if (joint.motion == JointTree::Motion::kNone) continue;
    const bool slides = joint.motion == JointTree::Motion::kSlides;
    const auto column = ColumnOf(columns, joint.name + (slides ? "_m" : "_rad"));
    if (column) joints.push_back({joint, *column});
  }
  if (joints.empty()) return;
  AddTake(path, [=, this, machine = tree->machine](const Record& record) {
    ros::TfMessage message;
    for (const MovingJoint& moving : joints) {
      message.transforms.push_back(
          {{job_->Stamp(record.t_ns), ros::FrameOf(machine, moving.joint.parent)},
           ros::FrameOf(machine, moving.joint.child),
           moving.joint.ChildInParent(record.values[moving.column])});
    }
    Write(transforms_, job_->Stamp(record.t_available_ns), message);
  });
}

void RosTopics::AddCylinders(const std::string& path) {
  const std::string machine = MachineOf(path), frame_id = RootFrameOf(machine);
  const std::vector<JointColumns> cylinders =
      JointColumnsOf(ColumnsOf(path), "_stroke_m", "_mps", "_n");
  if (cylinders.empty()) return;
  const TopicId id = AddTopic<ros::JointState>(ros::TopicOf(machine, "cylinders"), kState);
  AddTake(path, [=, this](const Record& record) {
    Write(id, job_->Stamp(record.t_available_ns),
          JointStateOf(cylinders, record, frame_id, job_->Stamp(record.t_ns)));
  });
}

void RosTopics::AddTool(const std::string& path, const std::vector<std::string>& columns) {
  const std::string machine = MachineOf(path);
  const JointTree* const tree = job_->JointTreeOf(machine);
  if (tree == nullptr || !tree->tool) return;
  std::string lacks;
  const std::vector<PathStep> way = PathToLink(tree->tool->link, *tree, columns, &lacks);
  if (!lacks.empty()) return;
  const TopicId id = AddTopic<ros::PoseStamped>(ros::TopicOf(machine, "ee_pose"), kState);
  AddTake(path, [=, this, X_LT = tree->tool->X_LT](const Record& record) {
    Write(id, job_->Stamp(record.t_available_ns),
          ros::PoseStamped{{job_->Stamp(record.t_ns), RootFrameOf(machine)},
                           X_RL(way, record) * X_LT});
  });
}

void RosTopics::AddLevers(const std::string& path) {
  const std::string machine = MachineOf(path);
  const JointTree* const tree = job_->JointTreeOf(machine);
  const auto is_column_of = [](const ros::NamedLever& lever, const std::string& column) {
    return lever.name == column;
  };
  if (tree == nullptr || !std::ranges::equal(tree->levers, ColumnsOf(path), is_column_of)) return;
  const TopicId id = AddTopic<ros::DeltaCan>(ros::TopicOf(machine, "delta_can"), kSensorData);
  AddTake(path, [=, this, levers = tree->levers](const Record& record) {
    Write(id, job_->Stamp(record.t_available_ns),
          DeltaCanOf(levers, record.values, job_->Stamp(record.t_ns)));
  });
}

}  // namespace tera
