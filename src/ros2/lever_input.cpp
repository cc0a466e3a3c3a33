#include "ros2/lever_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dataset/ros/delta_can.h"
#include "ros2/names.h"

namespace tera::ros {
namespace {

TimeNs StampOf(const DeltaCan& message) {
  return message.stamp_sec * kNsPerSecond + message.stamp_nanosec;
}

bool IsLever(float value) { return std::isfinite(value) && std::abs(value) <= 1; }

bool IsPowerOfTen(std::int64_t n) {
  while (n > 1 && n % 10 == 0) n /= 10;
  return n == 1;
}

}  // namespace

float DeltaCan::*FieldOf(const Lever& lever) { return FieldOfLever(lever.name, lever.gear >= 0); }

std::optional<std::string> FaultOf(const DeltaCan& message, const MachineModel& model) {
  if (message.stamp_sec < 0 || message.stamp_nanosec >= kNsPerSecond) {
    return fmt::format("its stamp is {} s {} ns, need a time from 0 on, below 10^9 ns",
                       message.stamp_sec, message.stamp_nanosec);
  }
  for (const DeltaCanField& field : kDeltaCanFields) {
    const float value = message.*field.value;
    if (!IsLever(value)) return fmt::format("{} is {}, need -1 to 1", field.name, value);
  }
  const std::size_t without_field = std::count_if(model.levers.begin(), model.levers.end(),
                                                  [](const Lever& l) { return !FieldOf(l); });
  if (!message.others.empty() && message.others.size() != without_field) {
    return fmt::format("others has {} levers, need none or {}", message.others.size(),
                       without_field);
  }
  for (std::size_t i = 0; i < message.others.size(); ++i) {
    if (!IsLever(message.others[i])) {
      return fmt::format("others[{}] is {}, need -1 to 1", i, message.others[i]);
    }
  }
  return std::nullopt;
}

ControlMessage ControlOf(const DeltaCan& message, const MachineModel& model) {
  ControlMessage::Levers levers;
  std::size_t other = 0;
  for (const Lever& lever : model.levers) {
    if (float DeltaCan::*const field = FieldOf(lever)) {
      levers.position.push_back(message.*field);
    } else {
      levers.position.push_back(message.others.empty() ? 0 : message.others[other]);
      ++other;
    }
  }
  ControlMessage control;
  control.command = std::move(levers);
  control.enable = message.enable;
  control.hydraulic_lock = message.hydraulic_lock;
  control.high_speed = message.high_speed;
  return control;
}

LeverInput::LeverInput(const Scenario& scenario, Participant* participant, Obey obey, Log log)
    : scenario_(scenario), participant_(participant), obey_(obey), log_(std::move(log)) {
  for (const ScenarioMachine& machine : scenario.machines) {
    Input input;
    if (!machine.placement.model.levers.empty()) {
      input.reader = participant->SubscribeToLevers(TopicOf(machine.placement.name, "delta_can"));
    }
    inputs_.push_back(input);
  }
}

void LeverInput::Take(TimeNs now_ns,
                      const std::function<void(std::size_t, const ControlMessage&)>& command) {
  for (std::size_t m = 0; m < inputs_.size(); ++m) {
    if (!inputs_[m].reader) continue;
    const MachineModel& model = scenario_.machines[m].placement.model;
    std::optional<DeltaCan> obeyed;
    for (const DeltaCan& message : participant_->TakeLevers(*inputs_[m].reader)) {
      if (const auto fault = FaultOf(message, model)) {
        Refuse(m, *fault);
        continue;
      }
      ++received_;
      if (IsObeyed(m, now_ns, message)) obeyed = message;
    }
    if (obeyed) command(m, ControlOf(*obeyed, model));
  }
}

bool LeverInput::IsObeyed(std::size_t machine, TimeNs now_ns, const DeltaCan& message) {
  Input& input = inputs_[machine];
  const TimeNs stamp_ns = StampOf(message);
  if (stamp_ns <= now_ns) input.heard_ns = std::max(input.heard_ns, stamp_ns);
  const bool first_answer = stamp_ns == now_ns && input.answered_ns != now_ns;
  if (first_answer) input.answered_ns = now_ns;
  if (obey_ == Obey::kLast || first_answer) return true;
  LeaveUnasked(machine, now_ns, stamp_ns);
  return false;
}

void LeverInput::Refuse(std::size_t machine, const std::string& fault) {
  ++refused_;
  if (!IsPowerOfTen(refused_)) return;
  log_(fmt::format("{}: levers refused: {} ({} refused so far)",
                   scenario_.machines[machine].placement.name, fault, refused_));
}

void LeverInput::LeaveUnasked(std::size_t machine, TimeNs now_ns, TimeNs stamp_ns) {
  ++unasked_;
  if (!IsPowerOfTen(unasked_)) return;
  const std::string why =
      stamp_ns == now_ns
          ? "an answer has been taken already"
          : fmt::format("/clock says {:.9f} s, and only levers with that stamp count",
                        ToSeconds(now_ns));
  log_(fmt::format("{}: levers stamped {:.9f} s not taken: {} ({} not taken so far)",
                   scenario_.machines[machine].placement.name, ToSeconds(stamp_ns), why, unasked_));
}

bool LeverInput::HasPublisher(std::size_t machine) const {
  return inputs_[machine].reader && participant_->HasLeverWriters(*inputs_[machine].reader);
}

bool LeverInput::Answered(std::size_t machine, TimeNs now_ns) const {
  return inputs_[machine].answered_ns == now_ns;
}

}  // namespace tera::ros
