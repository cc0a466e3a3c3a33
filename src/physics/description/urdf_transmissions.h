#pragma once

#include <tinyxml2.h>

#include <filesystem>

#include "core/config/config.h"
#include "physics/description/link_tree.h"

/// Drives of a URDF.
///
/// Model   A transmission joins one actuator to one joint: joint rate = actuator rate /
///         |reduction|, joint effort = actuator effort * |reduction|. The narrowest limit of a
///         joint applies: its own, that of its actuator, or that of its command interface. If a
///         URDF names any drives, joints without a drive swing freely.
/// Omits   Differential and four-bar transmissions, offsets. The quantity of a command interface: a
///         lever commands a rate, whether the robot takes positions, velocities or efforts.
/// Source  ROS wiki, urdf/Transmission; ROS 2 control, "Hardware components" and "Transmissions".

namespace tera {

/// Reads `<transmission>` and `<ros2_control>` of the URDF `file`, and actuator limits in
/// `actuators:` of `config`. Sets rates, efforts and limits of the joints in `parts`, and lists
/// driven joints in `parts->driven`. A following joint is not driven; a remark reports it. Faults
/// go to `config`.
void ReadUrdfDrives(const ConfigMap& config, const std::filesystem::path& file,
                    const tinyxml2::XMLElement& robot, MachineParts* parts);

/// Reports driven joints that lack a rate or an effort.
void CheckDriven(const MachineParts& parts);

}  // namespace tera
