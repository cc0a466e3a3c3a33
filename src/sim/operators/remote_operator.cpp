#include "sim/operators/remote_operator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/operators/joint_servo.h"

namespace tera {
namespace {

/// Gains on a joint's position error, for commanded rates and for commanded positions. The second
/// is low, so that a joint with high inertia and a delay does not oscillate about its target.
constexpr double kRateGain_1ps = 4.0, kPlaceGain_1ps = 1.8;
/// Largest lead of the integrated target over a joint that cannot follow.
constexpr double kLead_rad = 0.05;
/// Parameters for joints with a position target. Such a joint comes to rest when its ideal lever
/// has fallen to about 0.012. For the fastest joint this is 0.4 degrees from the target. The learnt
/// widths of dead zones grow only while the joint is nearly at rest.
constexpr DeadZoneAdaptation kPositioning = {.transition = 0.012,
                                             .follow_ratio = 0.15,
                                             .overshoot_ratio = 1.5,
                                             .rebound_ratio = 0.15,
                                             .wait_s = 0.6,
                                             .rate_1ps = 0.3};
/// Allowed excess over full lever, for rounding by the sender.
constexpr double kMessageRounding = 1e-6;

/// Allowed excess over a joint's limit (rad or m), because an elastic stop yields.
constexpr double kStopYield_rad = 0.02;

/// Target positions farther from the root link are rejected as typing errors.
constexpr double kFarthest_m = 1000.0;

std::optional<std::string> FaultOfNumbers(const std::vector<double>& numbers, const char* what,
                                          const MachineModel& model) {
  if (numbers.size() != model.levers.size()) {
    return fmt::format("{} {}, need {}, one for each lever of '{}'", numbers.size(), what,
                       model.levers.size(), model.kind);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i])) {
      return fmt::format("{} of '{}' is {}, need a finite number", what, model.levers[i].name,
                         numbers[i]);
    }
  }
  return std::nullopt;
}

std::optional<std::string> FaultOfLevers(const std::vector<double>& position,
                                         const MachineModel& model) {
  if (auto fault = FaultOfNumbers(position, "lever positions", model)) return fault;
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (std::abs(position[i]) > 1 + kMessageRounding) {
      return fmt::format("lever '{}' is {}, need -1 to 1", model.levers[i].name, position[i]);
    }
  }
  return std::nullopt;
}

std::optional<std::string> FaultOfPositions(const std::vector<double>& q_rad,
                                            const MachineModel& model) {
  if (auto fault = FaultOfNumbers(q_rad, "joint positions", model)) return fault;
  for (std::size_t i = 0; i < q_rad.size(); ++i) {
    if (model.levers[i].joint < 0) continue;
    const Joint& joint = model.joints[model.levers[i].joint];
    if (joint.type == JointType::kContinuous) continue;
    if (q_rad[i] < joint.lower_rad - kStopYield_rad ||
        q_rad[i] > joint.upper_rad + kStopYield_rad) {
      return fmt::format("joint position {} of '{}' is beyond the joint's limits, need {} to {}",
                         q_rad[i], model.levers[i].name, joint.lower_rad, joint.upper_rad);
    }
  }
  return std::nullopt;
}

const NamedFrame* FrameOf(const MachineModel& model, const std::string& name) {
  const auto frame = std::find_if(model.frames.begin(), model.frames.end(),
                                  [&](const NamedFrame& f) { return f.name == name; });
  return frame == model.frames.end() ? nullptr : &*frame;
}

std::optional<std::string> FaultOfToolPose(const ControlMessage::ToolPose& pose,
                                           const MachineModel& model) {
  if (FrameOf(model, pose.frame) == nullptr) {
    return fmt::format("machine '{}' has no frame '{}'", model.kind, pose.frame);
  }
  if (!pose.target.p_BF_m.allFinite() ||
      (pose.target.R_BF &&
       (!pose.target.R_BF->allFinite() || !pose.target.R_BF->isUnitary(1e-6)))) {
    return "the pose of '" + pose.frame + "' is not a position and a rotation, need finite numbers";
  }
  if (pose.target.p_BF_m.cwiseAbs().maxCoeff() > kFarthest_m) {
    return fmt::format("the place of '{}' is beyond {} m, need a place within reach of a tool",
                       pose.frame, kFarthest_m);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> FaultOf(const ControlMessage& message, const MachineModel& model) {
  if (const auto* levers = std::get_if<ControlMessage::Levers>(&message.command)) {
    return FaultOfLevers(levers->position, model);
  }
  if (const auto* rates = std::get_if<ControlMessage::JointRates>(&message.command)) {
    return FaultOfNumbers(rates->rate_radps, "joint rates", model);
  }
  if (const auto* positions = std::get_if<ControlMessage::JointPositions>(&message.command)) {
    return FaultOfPositions(positions->q_rad, model);
  }
  return FaultOfToolPose(std::get<ControlMessage::ToolPose>(message.command), model);
}

RemoteOperator::RemoteOperator(std::unique_ptr<Operator> until_then)
    : until_then_(std::move(until_then)) {}

void RemoteOperator::Receive(TimeNs t_ns, const ControlMessage& message) {
  const bool goes_on = message_ &&
                       std::holds_alternative<ControlMessage::JointRates>(message_->command) &&
                       std::holds_alternative<ControlMessage::JointRates>(message.command);
  if (!goes_on) held_q_rad_.clear();
  if (!message_) last_ns_ = t_ns;
  message_ = message;
  received_ns_ = t_ns;
}

std::vector<double> RemoteOperator::HoldRates(const OperatorView& view,
                                              const std::vector<double>& rates_radps) {
  const MachineModel& model = view.model;
  const bool begins = held_q_rad_.empty();
  const double dt_s = begins ? 0.0 : ToSeconds(view.t_ns - last_ns_);
  held_q_rad_.resize(model.levers.size());
  std::vector<double> levers(model.levers.size(), 0.0);
  for (std::size_t i = 0; i < levers.size(); ++i) {
    const Lever& lever = model.levers[i];
    if (lever.gear >= 0) {
      const GearDrive& drive = model.gear_drives[lever.gear];
      const double most = message_->high_speed ? 1.0 : drive.low_speed_ratio;
      const double full_radps = drive.max_rate_radps;
      levers[i] = full_radps > 0 ? std::clamp(rates_radps[i] / full_radps, -most, most) : 0.0;
    } else if (lever.joint >= 0) {
      const double q_rad = view.state.q_rad[lever.joint];
      double& held_rad = held_q_rad_[i];
      if (begins) held_rad = q_rad;
      held_rad = std::clamp(held_rad + rates_radps[i] * dt_s, q_rad - kLead_rad, q_rad + kLead_rad);
      levers[i] =
          ServoLever(model, view.state, lever.joint, held_rad, rates_radps[i], kRateGain_1ps);
    }
  }
  return levers;
}

std::vector<double> RemoteOperator::CompensateDeadZones(const OperatorView& view,
                                                        std::vector<double> levers) {
  const double dt_s = ToSeconds(view.t_ns - last_ns_);
  dead_zones_.resize(levers.size(), DeadZoneCompensation(kPositioning));
  for (std::size_t i = 0; i < levers.size(); ++i) {
    const int joint = view.model.levers[i].joint;
    if (joint < 0) continue;
    levers[i] =
        dead_zones_[i].Lever(levers[i], ShareOfFullRate(view.model, view.state, joint), dt_s);
  }
  return levers;
}

std::vector<double> RemoteOperator::LeversFor(const OperatorView& view) {
  const MachineModel& model = view.model;
  if (const auto* levers = std::get_if<ControlMessage::Levers>(&message_->command)) {
    return levers->position;
  }
  if (const auto* rates = std::get_if<ControlMessage::JointRates>(&message_->command)) {
    return HoldRates(view, rates->rate_radps);
  }
  std::vector<double> levers(model.levers.size(), 0.0);
  std::vector<int> joints;
  std::vector<std::size_t> lever_of;
  for (std::size_t i = 0; i < levers.size(); ++i) {
    if (model.levers[i].joint < 0) continue;
    joints.push_back(model.levers[i].joint);
    lever_of.push_back(i);
  }
  if (const auto* positions = std::get_if<ControlMessage::JointPositions>(&message_->command)) {
    for (const std::size_t i : lever_of) {
      levers[i] = ServoLever(model, view.state, model.levers[i].joint, positions->q_rad[i], 0.0,
                             kPlaceGain_1ps);
    }
    return CompensateDeadZones(view, std::move(levers));
  }
  const auto& pose = std::get<ControlMessage::ToolPose>(message_->command);
  const std::vector<double> rates_radps =
      ToolRates(model, view.state, *FrameOf(model, pose.frame), pose.target, joints);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const Joint& joint = model.joints[joints[k]];
    const double full_radps =
        rates_radps[k] > 0 ? joint.max_rate_positive_radps : joint.max_rate_negative_radps;
    if (full_radps > 0) levers[lever_of[k]] = std::clamp(rates_radps[k] / full_radps, -1.0, 1.0);
  }
  return CompensateDeadZones(view, std::move(levers));
}

std::vector<double> RemoteOperator::Levers(const OperatorView& view) {
  if (!message_) return until_then_->Levers(view);
  const bool neutral = !message_->enable || message_->hydraulic_lock ||
                       ToSeconds(view.t_ns - received_ns_) >= kTimeout_s;
  if (neutral) {
    held_q_rad_.clear();
    last_ns_ = view.t_ns;
    return std::vector<double>(view.model.levers.size(), 0.0);
  }
  std::vector<double> levers = LeversFor(view);
  last_ns_ = view.t_ns;
  if (message_->high_speed || !std::holds_alternative<ControlMessage::Levers>(message_->command)) {
    return levers;
  }
  for (std::size_t i = 0; i < levers.size(); ++i) {
    const int gear = view.model.levers[i].gear;
    if (gear >= 0) levers[i] *= view.model.gear_drives[gear].low_speed_ratio;
  }
  return levers;
}

}  // namespace tera
