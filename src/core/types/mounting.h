#pragma once

#include <string>

#include "core/motion.h"

namespace tera {

/// YAML text of a sensor's mounting, for sensor.yaml. It holds parent_link and the pose
/// X_parent_sensor. The pose appears twice: as a row-major 4x4 matrix, and as position and
/// quaternion.
std::string MountingYaml(const std::string& parent_link, const Pose& X_parent_sensor);

}  // namespace tera
