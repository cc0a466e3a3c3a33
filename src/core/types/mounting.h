#pragma once

#include <string>

#include "core/motion.h"

namespace tera {

/// Where a sensor sits on its machine, as sensor.yaml says it: parent_link, and X_parent_sensor as
/// a row-major 4x4 matrix and as position and quaternion.
std::string MountingYaml(const std::string& parent_link, const Pose& X_parent_sensor);

}  // namespace tera
