#pragma once

#include <string>

#include "core/motion.h"

namespace tera {

/// Sensor mounting as YAML for sensor.yaml: parent_link and X_parent_sensor, both as a row-major
/// 4x4 matrix and as position and quaternion.
std::string MountingYaml(const std::string& parent_link, const Pose& X_parent_sensor);

}  // namespace tera
