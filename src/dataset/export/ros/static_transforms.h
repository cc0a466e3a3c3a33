#pragma once

#include <vector>

#include "dataset/export/export_job.h"
#include "dataset/ros/messages.h"

namespace tera {

/// Transforms that never change: fixed joints, stationary machines, sensors on their links, and
/// optical frames of cameras.
std::vector<ros::TransformStamped> StaticTransforms(ExportJob* job);

}  // namespace tera
