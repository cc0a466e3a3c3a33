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

/// A command from an external controller to a machine. It holds until the next message.
struct ControlMessage {
  /// Positions in [-1, 1], one for each lever.
  struct Levers {
    std::vector<double> position;
  };
  /// Joint rates, one for each lever: rad/s, m/s for a prismatic joint, and rad/s of the sprockets
  /// or wheels for a lever of running gear.
  struct JointRates {
    std::vector<double> rate_radps;
  };
  /// Joint positions, one for each lever, in rad or m. Entries of running gears are ignored; the
  /// gears stand still.
  struct JointPositions {
    std::vector<double> q_rad;
  };
  /// Target pose of a named frame relative to the root link. The joints in between move it there.
  /// Running gears stand still.
  struct ToolPose {
    std::string frame;
    ToolTarget target;
  };

  std::variant<Levers, JointRates, JointPositions, ToolPose> command = Levers{};
  bool enable = true;           ///< false: all levers neutral
  bool hydraulic_lock = false;  ///< true: all levers neutral, like the safety lever of a cab
  bool high_speed = true;       ///< false: running gears at low speed
};

/// Describes the fault of a message for this machine; empty if it has none. Faults: a wrong number
/// of entries; a lever beyond +-1; a number that is not finite; a position beyond the joint's
/// limits; an unknown frame; an implausibly far target.
std::optional<std::string> FaultOf(const ControlMessage& message, const MachineModel& model);

/// Operator that an external controller can take over. The scenario's own operator acts until the
/// first message.
///
/// Model   a message holds until the next one, but at most kTimeout_s of simulated time; then all
///         levers are neutral.
///         Joint rates: feedback on the integrated angle, so that a loaded joint does not fall
///         behind. Joint positions and tool poses: proportional feedback (ServoLever, ToolRates),
///         through DeadZoneCompensation.
///         Every command becomes lever positions. The machine obeys these, and the recording
///         contains them.
class RemoteOperator : public Operator {
 public:
  static constexpr double kTimeout_s = 1.0;

  explicit RemoteOperator(std::unique_ptr<Operator> until_then);

  /// Applies a message from the step that begins at `t_ns`. The message must have no fault.
  void Receive(TimeNs t_ns, const ControlMessage& message);
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  std::vector<double> LeversFor(const OperatorView& view);
  /// Converts levers of ideal joints to levers of the real ones.
  std::vector<double> CompensateDeadZones(const OperatorView& view, std::vector<double> levers);
  std::vector<double> HoldRates(const OperatorView& view, const std::vector<double>& rates_radps);

  std::unique_ptr<Operator> until_then_;
  std::optional<ControlMessage> message_;
  TimeNs received_ns_ = 0, last_ns_ = 0;
  std::vector<double> held_q_rad_;  ///< integrated targets of commanded joint rates, one per lever
  /// One per lever; used for positions and tool poses.
  std::vector<DeadZoneCompensation> dead_zones_;
};

}  // namespace tera
