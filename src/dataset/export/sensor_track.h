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
  /// From one to the next, on average; 0 where there is only one.
  TimeNs MeanPeriod_ns() const { return count > 1 ? (last_ns - first_ns) / (count - 1) : 0; }
};

/// "truth/excavator1/sensors/lidar.csv" of "excavator1/lidar".
std::string SensorPoseFile(const std::string& sensor);

/// Where a sensor truly was over a recording.
///
/// Frames  W world, S sensor.
/// Model   truth/<machine>/sensors/<sensor>.csv where the recording has it (`record: {poses_hz}`);
///         else the machine's true pose, its joints' true positions and its joint tree, at the
///         times of the joints, and the mounting of sensor.yaml.
///
/// Throws InputError where it has neither.
SensorPoses SensorTrack(ExportJob* job, const std::string& sensor);

/// Where a machine's root link was. Throws InputError where that was not recorded.
SensorPoses MachineTrack(const ExportJob& job, const std::string& machine);

}  // namespace tera
