#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"
#include "sim/operators/operator.h"
#include "sim/operators/skid_steer.h"

namespace tera {

/// Commands over time, each held until the next (zero-order hold), the last to the end; neutral
/// before the first.
struct CommandTable {
  std::vector<TimeNs> t_ns;
  std::vector<std::vector<double>> rows;  ///< one value for each column
};

/// Index of the row in force at `t_ns`, or -1.
int RowInForce(const CommandTable& table, TimeNs t_ns);

/// Replays recorded lever positions.
class LeverReplay : public Operator {
 public:
  /// `lever_of_column[c]` is the lever that column c moves.
  LeverReplay(CommandTable table, std::vector<int> lever_of_column);
  std::vector<double> Levers(const OperatorView& view) override;
  const CommandTable& table() const { return table_; }

 private:
  CommandTable table_;
  std::vector<int> lever_of_column_;
};

/// Replays recorded body velocity commands (forward speed in m/s, yaw rate in rad/s) on a machine
/// that steers by skidding.
///
/// Model   SetSkidSteer with the machine's nominal gauge.
class TwistReplay : public Operator {
 public:
  TwistReplay(CommandTable table, const SkidSteerLevers& levers);
  std::vector<double> Levers(const OperatorView& view) override;
  const CommandTable& table() const { return table_; }

 private:
  CommandTable table_;
  SkidSteerLevers levers_;
};

/// The levers that a replaying operator gives, a row wherever they may change, a column for each
/// lever of the model. No rows for operators that look at the machine before they act.
CommandTable ReplayedLevers(Operator* driver, const MachineModel& model);

/// Reads the keys of `type: lever_replay` and `type: twist_replay`.
std::unique_ptr<Operator> ReadLeverReplay(const ConfigMap& config, const MachineModel& model);
std::unique_ptr<Operator> ReadTwistReplay(const ConfigMap& config, const MachineModel& model);

}  // namespace tera
