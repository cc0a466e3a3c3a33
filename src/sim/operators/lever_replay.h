#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "sim/operators/operator.h"
#include "sim/operators/skid_steer.h"

namespace tera {

/// Commands over time, each held until the next (zero-order hold), the last until the end; neutral
/// until the first.
struct CommandTable {
  std::vector<TimeNs> t_ns;
  std::vector<std::vector<double>> rows;  ///< one value per column
};

/// Index of the row in force at `t_ns`, or -1.
int RowInForce(const CommandTable& table, TimeNs t_ns);

/// Lever positions for a replay.
struct LeverReplayPlan {
  std::shared_ptr<const CommandTable> table;
  std::vector<int> lever_of_column;  ///< index of the lever of each column
};

/// Replays recorded lever positions.
class LeverReplay : public Operator {
 public:
  explicit LeverReplay(LeverReplayPlan plan) : plan_(std::move(plan)) {}
  std::vector<double> Levers(const OperatorView& view) override;

 private:
  LeverReplayPlan plan_;
};

/// Body velocity commands for a replay: columns forward speed in m/s, yaw rate in rad/s.
struct TwistReplayPlan {
  std::shared_ptr<const CommandTable> table;
  SkidSteerLevers levers;
};

/// Replays recorded body velocity commands on a machine with skid steering.
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
