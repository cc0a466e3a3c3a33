#pragma once

#include <vector>

#include "dataset/ros/messages.h"
#include "physics/description/machine.h"
#include "sim/end_effector.h"
#include "sim/scenario/scenario.h"

/// Convert true machine states to ROS messages.

namespace tera::ros {

/// Pose and velocity of the root link in the world.
Odometry OdometryMessage(TimeNs t_ns, const ScenarioMachine& machine, const MachineState& state);

/// All movable joints, then the running gears, named as in the machine description. The frame is
/// that of the root link.
JointState JointStateMessage(TimeNs t_ns, const ScenarioMachine& machine,
                             const MachineState& state);

/// Stroke (m), rate and force (N, positive when extending) of each cylinder, named as in the
/// machine description. For parallel cylinders, the values are those of one cylinder.
JointState CylindersMessage(TimeNs t_ns, const ScenarioMachine& machine, const MachineState& state);

/// Frames that move: the root in the world, unless fixed, and the child of each movable joint in
/// its parent.
std::vector<TransformStamped> MovingTransforms(TimeNs t_ns, const ScenarioMachine& machine,
                                               const MachineState& state);

/// Frames that never move: a fixed root in the world, children of fixed joints, sensors on their
/// links, and optical frames of cameras.
std::vector<TransformStamped> StaticTransforms(TimeNs t_ns, const ScenarioMachine& machine,
                                               const MachineState& state);

/// Pose of the tool frame T in the frame of the root link.
PoseStamped EndEffectorMessage(TimeNs t_ns, const ScenarioMachine& machine,
                               const MachineState& state, const EndEffector& tool);

/// Soil mass in the tool in kg.
Float64 BucketMassMessage(const MachineState& state, const EndEffector& tool);

}  // namespace tera::ros
