#pragma once

#include <vector>

#include "dataset/ros/messages.h"
#include "physics/description/machine.h"
#include "sim/end_effector.h"
#include "sim/scenario/scenario.h"

/// True machine states as ROS messages.

namespace tera::ros {

/// The root link in the world.
Odometry OdometryMessage(TimeNs t_ns, const ScenarioMachine& machine, const MachineState& state);

/// All movable joints, followed by the running gears, with the machine description's names. The
/// frame is the root link's.
JointState JointStateMessage(TimeNs t_ns, const ScenarioMachine& machine,
                             const MachineState& state);

/// Stroke (m), rate and force (N, positive for extension) of each cylinder. Values of parallel
/// cylinders refer to a single one of them. Names are the machine description's.
JointState CylindersMessage(TimeNs t_ns, const ScenarioMachine& machine, const MachineState& state);

/// Moving frames: the root in the world, unless fixed, and the child of each movable joint in its
/// parent.
std::vector<TransformStamped> MovingTransforms(TimeNs t_ns, const ScenarioMachine& machine,
                                               const MachineState& state);

/// Static frames: a fixed root in the world, children of fixed joints, sensors on their links, and
/// optical frames of cameras.
std::vector<TransformStamped> StaticTransforms(TimeNs t_ns, const ScenarioMachine& machine,
                                               const MachineState& state);

/// The tool's frame T in the root link's frame.
PoseStamped EndEffectorMessage(TimeNs t_ns, const ScenarioMachine& machine,
                               const MachineState& state, const EndEffector& tool);

/// Soil mass in the tool, in kilogrammes.
Float64 BucketMassMessage(const MachineState& state, const EndEffector& tool);

}  // namespace tera::ros
