#pragma once

#include <vector>

#include "dataset/ros/messages.h"
#include "physics/description/machine.h"
#include "sim/end_effector.h"
#include "sim/scenario/scenario.h"

/// What a machine truly does, as ROS messages.

namespace tera::ros {

/// The root link in the world.
Odometry OdometryMessage(TimeNs t_ns, const ScenarioMachine& machine, const MachineState& state);

/// All joints that move, then the running gears, named as in the machine's description; the frame
/// is the root link's.
JointState JointStateMessage(TimeNs t_ns, const ScenarioMachine& machine,
                             const MachineState& state);

/// Strokes (m), their rates and forces (N, positive where the rod is pushed out), of each of those
/// side by side; named as in the machine's description.
JointState CylindersMessage(TimeNs t_ns, const ScenarioMachine& machine, const MachineState& state);

/// What moves: the root in the world, unless it is fixed there, and the child of each joint that
/// is not fixed in its parent.
std::vector<TransformStamped> MovingTransforms(TimeNs t_ns, const ScenarioMachine& machine,
                                               const MachineState& state);

/// What stays: a fixed root in the world, children of fixed joints, sensors on their links, and the
/// optical frames of cameras.
std::vector<TransformStamped> StaticTransforms(TimeNs t_ns, const ScenarioMachine& machine,
                                               const MachineState& state);

/// The tool's T in the root link's frame.
PoseStamped EndEffectorMessage(TimeNs t_ns, const ScenarioMachine& machine,
                               const MachineState& state, const EndEffector& tool);

/// Kilograms of soil in the tool.
Float64 BucketMassMessage(const MachineState& state, const EndEffector& tool);

}  // namespace tera::ros
