#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/operators/dead_zone_compensation.h"
#include "sim/operators/operator.h"
#include "sim/operators/tool_servo.h"

namespace tera {

/// What a machine is asked to do from outside, until the next message.
struct ControlMessage {
  /// Positions in [-1, 1], one for each lever.
  struct Levers {
    std::vector<double> position;
  };
  /// Rates of the levers' joints, rad/s (m/s where they slide), and of the sprockets or wheels of
  /// their running gears, rad/s; one for each lever.
  struct JointRates {
    std::vector<double> rate_radps;
  };
  /// Angles (or metres) of the levers' joints, one for each lever; those of running gears are not
  /// read, gears stand.
  struct JointPositions {
    std::vector<double> q_rad;
  };
  /// A named frame of the machine is taken to a place relative to the root link, by the joints
  /// between them; gears stand.
  struct ToolPose {
    std::string frame;
    ToolTarget target;
  };

  std::variant<Levers, JointRates, JointPositions, ToolPose> command = Levers{};
  bool enable = true;           ///< false: all levers neutral
  bool hydraulic_lock = false;  ///< true: all levers neutral, as by the lock lever of a real cab
  bool high_speed = true;       ///< false: running gears at their low speed
};

/// What is wrong with a message for this machine (a wrong count, a lever beyond full, a number that
/// is not finite, a position beyond the joint's limits, an unknown frame, a place out of all
/// reach), or nothing.
std::optional<std::string> FaultOf(const ControlMessage& message, const MachineModel& model);

/// A machine's operator once somebody drives it from outside: the scenario's own operator until the
/// first message, then the messages.
///
/// Model   A message holds until the next one, for at most kTimeout_s of simulated time; after that
///         all levers are neutral. Joint rates are held by the angle they lead to, so that a joint
///         under load does not fall behind; joint positions and tool poses by proportional feedback
///         of the rate (ServoLever, ToolRates), through DeadZoneCompensation. All of them become
///         levers, which is what a machine obeys, what is recorded, and what replays it.
class RemoteOperator : public Operator {
 public:
  static constexpr double kTimeout_s = 1.0;

  explicit RemoteOperator(std::unique_ptr<Operator> until_then);

  /// From the step that begins at `t_ns` on. The message must be without fault.
  void Receive(TimeNs t_ns, const ControlMessage& message);
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  std::vector<double> LeversFor(const OperatorView& view);
  /// Levers for those that ideal joints would need.
  std::vector<double> CompensateDeadZones(const OperatorView& view, std::vector<double> levers);
  std::vector<double> HoldRates(const OperatorView& view, const std::vector<double>& rates_radps);

  std::unique_ptr<Operator> until_then_;
  std::optional<ControlMessage> message_;
  TimeNs received_ns_ = 0, last_ns_ = 0;
  std::vector<double> held_q_rad_;  ///< where joint rates have led to, one for each lever
  std::vector<DeadZoneCompensation> dead_zones_;  ///< of each lever, for positions and tool poses
};

}  // namespace tera
