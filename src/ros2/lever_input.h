#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dataset/ros/messages.h"
#include "ros2/participant.h"
#include "sim/operators/remote_operator.h"
#include "sim/scenario/scenario.h"

namespace tera::ros {

/// Which field of DeltaCAN moves a lever, as of FieldOfLever.
float DeltaCan::*FieldOf(const Lever& lever);

/// What is wrong with a message: a lever that is no number or beyond -1 to 1, `others` of another
/// length than the machine has such levers, a stamp that is no time.
std::optional<std::string> FaultOf(const DeltaCan& message, const MachineModel& model);

/// The levers of `model` as a message without fault has them. Fields that move no lever are not
/// read.
ControlMessage ControlOf(const DeltaCan& message, const MachineModel& model);

/// Which of the good messages drive a machine.
enum class Obey {
  kLast,    ///< whatever they are stamped, the last that has come
  kAnswers  ///< of those stamped with the present simulated time, the first: lock-step
};

/// The lever messages of all machines, at /<machine>/delta_can.
class LeverInput {
 public:
  using Log = std::function<void(const std::string&)>;

  /// Subscribes for each machine that has levers. Keeps references to all; `log` is told of refused
  /// and of unasked messages, the 1st, 10th, 100th and so on.
  LeverInput(const Scenario& scenario, Participant* participant, Obey obey, Log log);

  /// Takes what has come by the simulated time `now_ns` and hands the message that each machine is
  /// to obey, if there is a new one, to `command(machine, message)`.
  void Take(TimeNs now_ns, const std::function<void(std::size_t, const ControlMessage&)>& command);

  /// Whether anybody publishes levers for the machine.
  bool HasPublisher(std::size_t machine) const;
  /// Whether a good message stamped `now_ns` has been taken for the machine.
  bool Answered(std::size_t machine, TimeNs now_ns) const;
  /// The latest stamp that a good message for the machine has had, those from the future aside; -1
  /// where none has come.
  TimeNs HeardOf(std::size_t machine) const { return inputs_[machine].heard_ns; }

  std::int64_t received() const { return received_; }  ///< good ones
  std::int64_t refused() const { return refused_; }
  /// Good ones that were not obeyed in lock-step: stamped with another time, or not the first.
  std::int64_t unasked() const { return unasked_; }

 private:
  struct Input {
    std::optional<Participant::ReaderId> reader;
    TimeNs answered_ns = -1, heard_ns = -1;
  };
  /// Whether the machine is to obey the good message.
  bool IsObeyed(std::size_t machine, TimeNs now_ns, const DeltaCan& message);
  void Refuse(std::size_t machine, const std::string& fault);
  void LeaveUnasked(std::size_t machine, TimeNs now_ns, TimeNs stamp_ns);

  const Scenario& scenario_;
  Participant* participant_;
  Obey obey_;
  Log log_;
  std::vector<Input> inputs_;  ///< one for each machine
  std::int64_t received_ = 0, refused_ = 0, unasked_ = 0;
};

}  // namespace tera::ros
