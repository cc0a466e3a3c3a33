#include "dataset/export/sensor_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.h"
#include "dataset/export/record_views.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void FailUnplaced(const ExportJob& job, const std::string& sensor,
                               const std::string& lacks) {
  throw InputError(fmt::format(
      "{}: where {} was is not known: {}; need a simulated recording with truth, best made with "
      "`record: {{poses_hz: N}}`",
      job.recording.directory().string(), sensor, lacks));
}

/// A joint on the way from the root to a link, and where a table has its position.
struct Step {
  JointTree::Joint joint;
  std::size_t column = 0;  ///< of a joint that moves
};

/// From the root to a link.
std::vector<Step> WayTo(const std::string& link, const JointTree& tree,
                        const std::vector<std::string>& columns, const ExportJob& job,
                        const std::string& sensor) {
  std::vector<Step> way;
  for (std::string at = link; at != tree.root;) {
    const auto joint = std::find_if(tree.joints.begin(), tree.joints.end(),
                                    [&](const JointTree::Joint& j) { return j.child == at; });
    if (joint == tree.joints.end()) {
      FailUnplaced(job, sensor, fmt::format("its machine has no link '{}'", at));
    }
    Step step{*joint};
    if (joint->motion != JointTree::Motion::kNone) {
      const bool slides = joint->motion == JointTree::Motion::kSlides;
      const auto column =
          std::find(columns.begin(), columns.end(), joint->name + (slides ? "_m" : "_rad"));
      if (column == columns.end()) {
        FailUnplaced(job, sensor, fmt::format("joints.csv has no joint '{}'", joint->name));
      }
      step.column = static_cast<std::size_t>(column - columns.begin());
    }
    way.insert(way.begin(), step);
    at = joint->parent;
  }
  return way;
}

SensorPoses RecordedTrack(const Recording& recording, const std::string& pose_file) {
  SensorPoses track;
  RecordStream stream(recording, std::vector<std::string>{pose_file});
  for (Record record; stream.Next(&record);) {
    track.Append(record.t_ns, PoseOf(stream, record).X_WB);
  }
  return track;
}

SensorPoses TrackByJoints(ExportJob* job, const std::string& sensor) {
  const Recording& recording = job->recording;
  const std::string machine = MachineOf(sensor);
  const std::string pose_file = "truth/" + machine + "/pose.csv";
  const std::string joints_file = "truth/" + machine + "/joints.csv";
  const JointTree* const tree = job->JointTreeOf(machine);
  const SensorSheet sheet = ReadSensorSheet(recording.directory() / sensor);
  if (!recording.Has(pose_file)) FailUnplaced(*job, sensor, "there is no " + pose_file);
  if (!recording.Has(joints_file)) FailUnplaced(*job, sensor, "there is no " + joints_file);
  if (tree == nullptr) FailUnplaced(*job, sensor, "its machine's joints are not known");
  if (!sheet.X_PS) FailUnplaced(*job, sensor, "its sensor.yaml has no X_parent_sensor");
  const PoseTrack roots = RecordedTrack(recording, pose_file).X_WS;
  if (roots.empty()) FailUnplaced(*job, sensor, pose_file + " has no rows");
  RecordStream joints(recording, std::vector<std::string>{joints_file});
  const std::vector<Step> way = WayTo(sheet.parent_link, *tree, joints.columns(0), *job, sensor);
  SensorPoses track;
  for (Record record; joints.Next(&record);) {
    Pose X_WL = roots.At(record.t_ns);
    for (const Step& step : way) {
      const bool moves = step.joint.motion != JointTree::Motion::kNone;
      X_WL = X_WL * step.joint.ChildInParent(moves ? record.values[step.column] : 0);
    }
    track.Append(record.t_ns, X_WL * *sheet.X_PS);
  }
  return track;
}

}  // namespace

void SensorPoses::Append(TimeNs t_ns, const Pose& pose) {
  if (count++ == 0) first_ns = t_ns;
  last_ns = t_ns;
  X_WS.Append(t_ns, pose);
}

std::string SensorPoseFile(const std::string& sensor) {
  return "truth/" + MachineOf(sensor) + "/sensors/" + fs::path(sensor).filename().string() + ".csv";
}

SensorPoses MachineTrack(const ExportJob& job, const std::string& machine) {
  const std::string file = "truth/" + machine + "/pose.csv";
  if (!job.recording.Has(file)) FailUnplaced(job, machine, "there is no " + file);
  const SensorPoses track = RecordedTrack(job.recording, file);
  if (track.count == 0) FailUnplaced(job, machine, file + " has no rows");
  return track;
}

SensorPoses SensorTrack(ExportJob* job, const std::string& sensor) {
  const std::string own = SensorPoseFile(sensor);
  const SensorPoses track =
      job->recording.Has(own) ? RecordedTrack(job->recording, own) : TrackByJoints(job, sensor);
  if (track.count == 0) FailUnplaced(*job, sensor, "its poses have no rows");
  return track;
}

}  // namespace tera
