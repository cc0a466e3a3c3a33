#pragma once

#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/ros/messages.h"

namespace tera {

/// The static transforms of a recording: fixed joints and stationary machines, sensors on their
/// links, optical frames of cameras.
std::vector<ros::TransformStamped> StaticTransforms(ExportJob* job);

}  // namespace tera
