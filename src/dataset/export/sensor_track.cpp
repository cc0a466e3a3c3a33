#include "dataset/export/sensor_track.h"

#include <fmt/format.h>

#include "core/error.h"
#include "dataset/export/link_path.h"
#include "dataset/export/record_views.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void FailUnplaced(const ExportJob& job, const std::string& sensor,
                               const std::string& lacks) {
  throw InputError(
      job.recording.directory().string(),
      {FaultKind::kMissing, fmt::format("the pose of {} is unknown: {}; need a simulated recording "
                                        "with truth, best with `record: {{poses_hz: N}}`",
                                        sensor, lacks)});
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
  if (tree == nullptr) FailUnplaced(*job, sensor, "its machine's joints are unknown");
  if (!sheet.X_PS) FailUnplaced(*job, sensor, "its sensor.yaml has no X_parent_sensor");
  const PoseTrack roots = RecordedTrack(recording, pose_file).X_WS;
  if (roots.empty()) FailUnplaced(*job, sensor, pose_file + " has no rows");
  RecordStream joints(recording, std::vector<std::string>{joints_file});
  std::string lacks;
  const std::vector<PathStep> path =
      PathToLink(sheet.parent_link, *tree, joints.columns(0), &lacks);
  if (!lacks.empty()) FailUnplaced(*job, sensor, lacks);
  SensorPoses track;
  for (Record record; joints.Next(&record);) {
    track.Append(record.t_ns, roots.At(record.t_ns) * X_RL(path, record) * *sheet.X_PS);
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
