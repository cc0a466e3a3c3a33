#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ros2/messages.h"
#include "ros2/participant.h"
#include "sim/remote_operator.h"
#include "sim/scenario.h"

namespace tera::ros {

/// Which field of DeltaCAN moves a lever: that of its own name; for the lever of a running gear,
/// `left_travel` or `right_travel` by how its name begins. Null where there is none.
float DeltaCan::*FieldOf(const Lever& lever);

/// What is wrong with a message: a lever that is no number or beyond -1 to 1, `others` of another
/// length than the machine has such levers, a stamp that is no time.
std::optional<std::string> FaultOf(const DeltaCan& message, const MachineModel& model);

/// The levers of `model` as a message without fault has them. Fields that move no lever are not
/// read.
ControlMessage ControlOf(const DeltaCan& message, const MachineModel& model);

/// The lever messages of all machines, at /<machine>/delta_can.
class LeverInput {
 public:
  using Log = std::function<void(const std::string&)>;

  /// Subscribes for each machine that has levers. Keeps references to all; `log` is told of refused
  /// messages, the 1st, 10th, 100th and so on.
  LeverInput(const Scenario& scenario, Participant* participant, Log log);

  /// Takes what has come by the simulated time `now_ns` and hands the last good message of each
  /// machine to `command(machine, message)`.
  void Take(TimeNs now_ns, const std::function<void(std::size_t, const ControlMessage&)>& command);

  /// Whether anybody publishes levers for the machine.
  bool HasPublisher(std::size_t machine) const;
  /// Whether a good message stamped `now_ns` has been taken for the machine.
  bool Answered(std::size_t machine, TimeNs now_ns) const;

  std::int64_t received() const { return received_; }
  std::int64_t refused() const { return refused_; }

 private:
  struct Input {
    std::optional<Participant::ReaderId> reader;
    TimeNs answered_ns = -1;
  };
  void Refuse(std::size_t machine, const std::string& fault);

  const Scenario& scenario_;
  Participant* participant_;
  Log log_;
  std::vector<Input> inputs_;  ///< one for each machine
  std::int64_t received_ = 0, refused_ = 0;
};

}  // namespace tera::ros
