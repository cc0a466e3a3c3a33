#pragma once

#include <string>

#include "core/motion.h"
#include "dataset/export/export_job.h"

namespace tera {

/// Where a sensor truly was over a recording.
///
/// Frames  W world, S sensor.
/// Model   truth/<machine>/sensors/<sensor>.csv where the recording has it (`record: {poses_hz}`);
///         else the machine's true pose, its joints' true positions and its joint tree, at the
///         times of the joints, and the mounting of sensor.yaml.
///
/// Throws InputError where it has neither.
PoseTrack SensorTrack(ExportJob* job, const std::string& sensor);

}  // namespace tera
