#pragma once

#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/ros/messages.h"

namespace tera {

/// What of a recording's frames does not move: fixed joints and machines that stand fast, sensors
/// on their links, optical frames of cameras.
std::vector<ros::TransformStamped> StaticTransforms(ExportJob* job);

}  // namespace tera
