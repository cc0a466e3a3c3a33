#include "ros2/from_machine.h"

#include "ros2/names.h"
#include "sensors/camera/camera.h"

namespace tera::ros {
namespace {

std::string LinkFrame(const ScenarioMachine& machine, int link) {
  return FrameOf(machine.placement.name, machine.placement.model.links[link].name);
}

Pose ChildInParent(const Joint& joint, const MachineState& state) {
  return state.links[joint.parent].X_WB.inverse() * state.links[joint.child].X_WB;
}

TransformStamped RootInWorld(TimeNs t_ns, const ScenarioMachine& machine,
                             const MachineState& state) {
  return {{t_ns, kWorldFrame}, LinkFrame(machine, 0), state.links[0].X_WB};
}

/// Appends the transforms of either the fixed or the movable joints.
void AppendJoints(TimeNs t_ns, const ScenarioMachine& machine, const MachineState& state,
                  bool fixed, std::vector<TransformStamped>* transforms) {
  for (const Joint& joint : machine.placement.model.joints) {
    if ((joint.type == JointType::kFixed) != fixed) continue;
    transforms->push_back({{t_ns, LinkFrame(machine, joint.parent)},
                           LinkFrame(machine, joint.child),
                           ChildInParent(joint, state)});
  }
}

}  // namespace

Odometry OdometryMessage(TimeNs t_ns, const ScenarioMachine& machine, const MachineState& state) {
  const BodyState& root = state.links[0];
  const Mat3 R_BW = root.X_WB.linear().transpose();
  return {{t_ns, kWorldFrame},
          LinkFrame(machine, 0),
          root.X_WB,
          R_BW * root.v_WB_mps,
          R_BW * root.w_WB_radps};
}

JointState JointStateMessage(TimeNs t_ns, const ScenarioMachine& machine,
                             const MachineState& state) {
  const MachineModel& model = machine.placement.model;
  JointState message;
  message.header = {t_ns, LinkFrame(machine, 0)};
  const auto add = [&](const std::string& name, double q, double qd, double effort) {
    message.name.push_back(name);
    message.position.push_back(q);
    message.velocity.push_back(qd);
    message.effort.push_back(effort);
  };
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].type == JointType::kFixed) continue;
    add(model.joints[j].name, state.q_rad[j], state.qd_radps[j], state.effort_nm[j]);
  }
  for (std::size_t g = 0; g < model.ground_tools.gears.size(); ++g) {
    add(model.ground_tools.gears[g].name, state.gear_angle_rad[g], state.gear_rate_radps[g],
        state.gear_torque_nm[g]);
  }
  return message;
}

JointState CylindersMessage(TimeNs t_ns, const ScenarioMachine& machine,
                            const MachineState& state) {
  const std::vector<Cylinder>& cylinders = machine.placement.model.cylinders;
  JointState message;
  message.header = {t_ns, LinkFrame(machine, 0)};
  for (std::size_t c = 0; c < cylinders.size(); ++c) {
    message.name.push_back(cylinders[c].name);
    message.position.push_back(state.cylinders[c].stroke_m);
    message.velocity.push_back(state.cylinders[c].rate_mps);
    message.effort.push_back(state.cylinders[c].force_n);
  }
  return message;
}

std::vector<TransformStamped> MovingTransforms(TimeNs t_ns, const ScenarioMachine& machine,
                                               const MachineState& state) {
  std::vector<TransformStamped> transforms;
  if (!machine.placement.model.fixed_base) {
    transforms.push_back(RootInWorld(t_ns, machine, state));
  }
  AppendJoints(t_ns, machine, state, /*fixed=*/false, &transforms);
  return transforms;
}

std::vector<TransformStamped> StaticTransforms(TimeNs t_ns, const ScenarioMachine& machine,
                                               const MachineState& state) {
  std::vector<TransformStamped> transforms;
  if (machine.placement.model.fixed_base) transforms.push_back(RootInWorld(t_ns, machine, state));
  AppendJoints(t_ns, machine, state, /*fixed=*/true, &transforms);
  const std::string& name = machine.placement.name;
  for (const SensorDescription& sensor : machine.sensors) {
    if (sensor.link.empty()) continue;
    const std::string frame = FrameOf(name, sensor.name);
    transforms.push_back({{t_ns, FrameOf(name, sensor.link)}, frame, sensor.X_BS});
    if (KindOf(sensor).form == ChannelForm::kPictures) {
      transforms.push_back({{t_ns, frame}, OpticalFrameOf(name, sensor.name), OpticalInSensor()});
    }
  }
  return transforms;
}

PoseStamped EndEffectorMessage(TimeNs t_ns, const ScenarioMachine& machine,
                               const MachineState& state, const EndEffector& tool) {
  const Pose X_WT = state.links[tool.link].X_WB * tool.X_BT;
  return {{t_ns, LinkFrame(machine, 0)}, state.links[0].X_WB.inverse() * X_WT};
}

Float64 BucketMassMessage(const MachineState& state, const EndEffector& tool) {
  return {state.shovel_load[tool.shovel].mass_kg};
}

}  // namespace tera::ros
