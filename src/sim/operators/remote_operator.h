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

/// An external command to a machine, valid until the next message.
struct ControlMessage {
  /// Positions in [-1, 1], one for each lever.
  struct Levers {
    std::vector<double> position;
  };
  /// Rates of the levers' joints, rad/s (m/s for sliding joints), and of the sprockets or wheels of
  /// their running gears, rad/s; one for each lever.
  struct JointRates {
    std::vector<double> rate_radps;
  };
  /// Positions of the levers' joints (rad or m), one for each lever. Entries of running gears are
  /// ignored; the gears stand still.
  struct JointPositions {
    std::vector<double> q_rad;
  };
  /// Target pose of a named frame relative to the root link, reached by the joints in between. The
  /// gears stand still.
  struct ToolPose {
    std::string frame;
    ToolTarget target;
  };

  std::variant<Levers, JointRates, JointPositions, ToolPose> command = Levers{};
  bool enable = true;           ///< false: all levers neutral
  bool hydraulic_lock = false;  ///< true: all levers neutral, as by the lock lever of a real cab
  bool high_speed = true;       ///< false: running gears at their low speed
};

/// The fault of a message for this machine, or nothing. Faults: a wrong count, a lever beyond full,
/// a number that is not finite, a position beyond the joint's limits, an unknown frame, a target
/// out of all reach.
std::optional<std::string> FaultOf(const ControlMessage& message, const MachineModel& model);

/// An operator that an external controller can take over: the scenario's own operator until the
/// first message, then the messages.
///
/// Model   A message holds until the next one, for at most kTimeout_s of simulated time; then all
///         levers are neutral. Joint rates are controlled by their integrated angle, so that a
///         loaded joint does not fall behind. Joint positions and tool poses use proportional
///         feedback of the rate (ServoLever, ToolRates) through DeadZoneCompensation. All commands
///         become levers, which the machine obeys and the recording contains.
class RemoteOperator : public Operator {
 public:
  static constexpr double kTimeout_s = 1.0;

  explicit RemoteOperator(std::unique_ptr<Operator> until_then);

  /// Takes effect from the step that begins at `t_ns`. The message must have no fault.
  void Receive(TimeNs t_ns, const ControlMessage& message);
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  std::vector<double> LeversFor(const OperatorView& view);
  /// Real levers for the levers of ideal joints.
  std::vector<double> CompensateDeadZones(const OperatorView& view, std::vector<double> levers);
  std::vector<double> HoldRates(const OperatorView& view, const std::vector<double>& rates_radps);

  std::unique_ptr<Operator> until_then_;
  std::optional<ControlMessage> message_;
  TimeNs received_ns_ = 0, last_ns_ = 0;
  std::vector<double> held_q_rad_;  ///< integrated target of the joint rates, one for each lever
  std::vector<DeadZoneCompensation> dead_zones_;  ///< one per lever, for positions and tool poses
};

}  // namespace tera
