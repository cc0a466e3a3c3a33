#pragma once

#include <tinyxml2.h>

#include <filesystem>

#include "core/config/config.h"
#include "physics/description/link_tree.h"

/// What a URDF says of its drives.
///
/// Model   a transmission joins one actuator to one joint: joint rate = actuator rate /
///         |reduction|, joint effort = actuator effort * |reduction|. Of all limits given for a
///         joint (its own, its actuator's, its command interface's) the narrowest holds. Where a
///         URDF names drives at all, joints without one swing freely.
/// Omits   differential and four-bar transmissions, offsets, what an interface commands (a lever
///         asks for a rate, whether the robot takes positions, velocities or efforts).
/// Source  ROS wiki, urdf/Transmission; ROS 2 control, "Hardware components" and "Transmissions".

namespace tera {

/// Reads `<transmission>` and `<ros2_control>` of the URDF `file`, and the limits of actuators in
/// `actuators:` of `config`. Sets rates, efforts and limits of the joints in `parts` and lists the
/// driven ones in `parts->driven`; of a joint that follows another a remark says that it is none.
/// Faults go to `config`.
void ReadUrdfDrives(const ConfigMap& config, const std::filesystem::path& file,
                    const tinyxml2::XMLElement& robot, MachineParts* parts);

/// Reports driven joints that cannot move for want of a rate or an effort.
void CheckDriven(const MachineParts& parts);

}  // namespace tera
