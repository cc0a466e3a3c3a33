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

/// Field of DeltaCAN for a lever (FieldOfLever); null if there is none.
float DeltaCan::*FieldOf(const Lever& lever);

/// Describes the fault of a message: a lever that is NaN or outside [-1, 1], `others` of a wrong
/// length, or an invalid stamp. Returns nullopt for a valid message.
std::optional<std::string> FaultOf(const DeltaCan& message, const MachineModel& model);

/// Command in a valid message for a machine of type `model`. Fields for levers that the machine
/// does not have are ignored.
ControlMessage ControlOf(const DeltaCan& message, const MachineModel& model);

/// Selection of the valid messages that a machine obeys.
enum class Obey {
  kLast,    ///< the latest message, with any stamp
  kAnswers  ///< lockstep: the first message whose stamp is the current simulated time
};

/// Lever messages on the topics /<machine>/delta_can.
class LeverInput {
 public:
  using Log = std::function<void(const std::string&)>;

  /// Subscribes for each machine that has levers. Keeps references to all arguments. `log` receives
  /// a line for every 1st, 10th, 100th, ... refused or ignored message.
  LeverInput(const Scenario& scenario, Participant* participant, Obey obey, Log log);

  /// Takes all messages that have arrived. For each machine, passes the message to obey, if any, to
  /// `command(machine, message)`. `now_ns` is the simulated time.
  void Take(TimeNs now_ns, const std::function<void(std::size_t, const ControlMessage&)>& command);

  /// True if the machine's topic has a publisher.
  bool HasPublisher(std::size_t machine) const;
  /// True if a valid message with the stamp `now_ns` was taken.
  bool Answered(std::size_t machine, TimeNs now_ns) const;
  /// Latest stamp of valid messages, apart from future stamps; -1 if there is none.
  TimeNs HeardOf(std::size_t machine) const { return inputs_[machine].heard_ns; }

  std::int64_t received() const { return received_; }  ///< number of valid messages
  std::int64_t refused() const { return refused_; }
  /// Valid messages that lockstep ignored: with another stamp, or repeated answers.
  std::int64_t unasked() const { return unasked_; }

 private:
  struct Input {
    std::optional<Participant::ReaderId> reader;
    TimeNs answered_ns = -1, heard_ns = -1;
  };
  /// True if the machine obeys this valid message.
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
