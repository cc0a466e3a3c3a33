#pragma once

#include <cstdint>
#include <string>

#include "core/motion.h"
#include "dataset/export/export_job.h"

namespace tera {

/// Poses of a sensor in W over time.
struct SensorPoses {
  PoseTrack X_WS;
  TimeNs first_ns = 0, last_ns = 0;
  std::int64_t count = 0;

  void Append(TimeNs t_ns, const Pose& pose);
  /// Mean interval; 0 for a single pose.
  TimeNs MeanPeriod_ns() const { return count > 1 ? (last_ns - first_ns) / (count - 1) : 0; }
};

/// "truth/excavator1/sensors/lidar.csv" for "excavator1/lidar".
std::string SensorPoseFile(const std::string& sensor);

/// The true poses of a sensor over a recording.
///
/// Frames  W world, S sensor.
/// Model   truth/<machine>/sensors/<sensor>.csv if the recording has it (`record: {poses_hz}`).
///         Otherwise the machine's true pose, its true joint positions, its joint tree and the
///         mounting in sensor.yaml, at the times of the joints.
///
/// Throws  InputError if it has neither.
SensorPoses SensorTrack(ExportJob* job, const std::string& sensor);

/// The poses of a machine's root link. Throws InputError if they were not recorded.
SensorPoses MachineTrack(const ExportJob& job, const std::string& machine);

}  // namespace tera
