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
  /// Mean interval between poses; 0 for a single pose.
  TimeNs MeanPeriod_ns() const { return count > 1 ? (last_ns - first_ns) / (count - 1) : 0; }
};

/// Path of the pose file: "truth/excavator1/sensors/lidar.csv" for "excavator1/lidar".
std::string SensorPoseFile(const std::string& sensor);

/// True poses of a sensor over a recording.
///
/// Frames  W world, S sensor.
/// Model   Reads truth/<machine>/sensors/<sensor>.csv if it exists (scenario key `record:
///         {poses_hz}`). Otherwise computes the poses at each row of joint positions, from the true
///         machine pose, the joint tree and the mounting in sensor.yaml.
/// Throws  InputError if the recording has neither.
SensorPoses SensorTrack(ExportJob* job, const std::string& sensor);

/// Poses of a machine's root link. Throws InputError if they were not recorded.
SensorPoses MachineTrack(const ExportJob& job, const std::string& machine);

}  // namespace tera
