#include "serve/action.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/error.h"
#include "serve/geometry_messages.h"
#include "serve/observation.h"

namespace tera {
namespace {

/// Tolerance of a quaternion's norm, which allows for rounding by the client.
constexpr double kUnitTolerance = 1e-4;

ControlMessage::ToolPose ToolPoseOf(const v1::ToolPose& pose) {
  ControlMessage::ToolPose command;
  command.frame = pose.frame();
  command.target.p_BF_m = Vec3Of(pose.position_b_m());
  if (pose.has_rotation_b()) {
    const v1::Quaternion& q = pose.rotation_b();
    const Quat rotation(q.w(), q.x(), q.y(), q.z());
    if (!(std::abs(rotation.norm() - 1) <= kUnitTolerance)) {
      throw InputError("", {FaultKind::kMalformed,
                            fmt::format("the quaternion of tool frame '{}' has length {}, need 1",
                                        pose.frame(), rotation.norm())});
    }
    command.target.R_BF = rotation.normalized().toRotationMatrix();
  }
  return command;
}

ControlMessage MessageOf(const v1::Action& action, const MachineModel& model) {
  ControlMessage message = Neutral(model);
  message.hydraulic_lock = action.hydraulic_lock();
  message.high_speed = !action.low_speed();
  switch (action.command_case()) {
    case v1::Action::kLevers: {
      const auto& position = action.levers().position();
      message.command = ControlMessage::Levers{{position.begin(), position.end()}};
      break;
    }
    case v1::Action::kJointRates: {
      const auto& rate = action.joint_rates().rate();
      message.command = ControlMessage::JointRates{{rate.begin(), rate.end()}};
      break;
    }
    case v1::Action::kJointPositions: {
      const auto& position = action.joint_positions().position();
      message.command = ControlMessage::JointPositions{{position.begin(), position.end()}};
      break;
    }
    case v1::Action::kToolPose:
      message.command = ToolPoseOf(action.tool_pose());
      break;
    case v1::Action::COMMAND_NOT_SET:
      break;
  }
  return message;
}

}  // namespace

ControlMessage Neutral(const MachineModel& model) {
  return {.command = ControlMessage::Levers{std::vector<double>(model.levers.size(), 0.0)}};
}

std::map<std::size_t, ControlMessage> CommandsOf(const v1::Step& step, const Scenario& scenario) {
  std::map<std::size_t, ControlMessage> commands;
  for (const v1::Action& action : step.actions()) {
    const std::size_t machine = MachineIndex(scenario, action.machine());
    const MachineModel& model = scenario.machines[machine].placement.model;
    const ControlMessage message = MessageOf(action, model);
    if (const auto fault = FaultOf(message, model)) {
      throw InputError(fmt::format("action of '{}'", action.machine()), *fault);
    }
    if (!commands.emplace(machine, message).second) {
      throw InputError("", {FaultKind::kRepeated,
                            fmt::format("machine '{}' has two actions in one step; need one",
                                        action.machine())});
    }
  }
  return commands;
}

}  // namespace tera
