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

/// Field of DeltaCAN for a lever; see FieldOfLever.
float DeltaCan::*FieldOf(const Lever& lever);

/// Fault of a message: a lever outside -1 to 1 or NaN, `others` of wrong length, or an invalid
/// stamp.
std::optional<std::string> FaultOf(const DeltaCan& message, const MachineModel& model);

/// Levers of `model` in a valid message. Fields without a lever are ignored.
ControlMessage ControlOf(const DeltaCan& message, const MachineModel& model);

/// Selection of the valid messages that drive a machine.
enum class Obey {
  kLast,    ///< the latest message, with any stamp
  kAnswers  ///< lockstep: the first message stamped with the present simulated time
};

/// Lever messages of all machines, at /<machine>/delta_can.
class LeverInput {
 public:
  using Log = std::function<void(const std::string&)>;

  /// Subscribes for each machine with levers. Keeps references to all arguments. `log` receives
  /// refused and unasked messages number 1, 10, 100 and so on.
  LeverInput(const Scenario& scenario, Participant* participant, Obey obey, Log log);

  /// Takes the messages that arrived by the simulated time `now_ns`. Passes each machine's selected
  /// new message to `command(machine, message)`.
  void Take(TimeNs now_ns, const std::function<void(std::size_t, const ControlMessage&)>& command);

  /// True if the machine has a lever publisher.
  bool HasPublisher(std::size_t machine) const;
  /// True if a valid message stamped `now_ns` has been taken for the machine.
  bool Answered(std::size_t machine, TimeNs now_ns) const;
  /// Latest stamp of the machine's valid messages, future stamps excluded; -1 without a message.
  TimeNs HeardOf(std::size_t machine) const { return inputs_[machine].heard_ns; }

  std::int64_t received() const { return received_; }  ///< valid messages
  std::int64_t refused() const { return refused_; }
  /// Valid messages ignored in lockstep: another stamp, or repeated answers.
  std::int64_t unasked() const { return unasked_; }

 private:
  struct Input {
    std::optional<Participant::ReaderId> reader;
    TimeNs answered_ns = -1, heard_ns = -1;
  };
  /// True if the valid message drives the machine.
  bool IsObeyed(std::size_t machine, TimeNs now_ns, const DeltaCan& message);
  void Refuse(std::size_t machine, const std::string& fault);
  void LeaveUnasked(std::size_t machine, TimeNs now_ns, TimeNs stamp_ns);

  const Scenario& scenario_;
  Participant* participant_;
  Obey obey_;
  Log log_;
  std::vector<Input> inputs_;  ///< one per machine
  std::int64_t received_ = 0, refused_ = 0, unasked_ = 0;
};

}  // namespace tera::ros
