#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "sim/operators/operator.h"
#include "sim/operators/skid_steer.h"

namespace tera {

/// Commands over time. A row holds until the next one, the last row without end. Before the first
/// row, commands are neutral.
struct CommandTable {
  std::vector<TimeNs> t_ns;
  std::vector<std::vector<double>> rows;  ///< one value per column
};

/// Index of the row that holds at `t_ns`; -1 before the first.
int RowInForce(const CommandTable& table, TimeNs t_ns);

/// Recorded lever positions of a machine.
struct LeverReplayPlan {
  std::shared_ptr<const CommandTable> table;
  std::vector<int> lever_of_column;  ///< lever index of each column
};

class LeverReplay : public Operator {
 public:
  explicit LeverReplay(LeverReplayPlan plan) : plan_(std::move(plan)) {}
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  LeverReplayPlan plan_;
};

/// Recorded velocity commands of a machine. Columns: forward speed in m/s, yaw rate in rad/s.
struct TwistReplayPlan {
  std::shared_ptr<const CommandTable> table;
  SkidSteerLevers levers;
};

/// Replays recorded velocity commands on a machine with skid steering.
///
/// Model   SetSkidSteer with the machine's nominal gauge.
class TwistReplay : public Operator {
 public:
  explicit TwistReplay(TwistReplayPlan plan) : plan_(std::move(plan)) {}
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  TwistReplayPlan plan_;
};

/// Reads the keys of `type: lever_replay` and `type: twist_replay`.
LeverReplayPlan ReadLeverReplay(const ConfigMap& config, const MachineModel& model);
TwistReplayPlan ReadTwistReplay(const ConfigMap& config, const MachineModel& model);

}  // namespace tera
