#include "sim/operators/read_operator.h"

#include "core/config/config_faults.h"
#include "sim/operators/dig_cycle.h"
#include "sim/operators/lever_replay.h"
#include "sim/operators/random_levers.h"
#include "sim/operators/waypoint_driver.h"

namespace tera {
namespace {

/// Leaves every lever neutral.
class Idle : public Operator {
 public:
  std::vector<double> Levers(const OperatorView& view) override {
    return std::vector<double>(view.model.levers.size(), 0.0);
  }
};

std::unique_ptr<Operator> ReadDigCycle(const ConfigMap& config, const MachineModel& model) {
  const std::optional<DigPlan> plan = ReadDigPlan(config, model);
  if (!plan) return std::make_unique<Idle>();  // the faults are on record
  return std::make_unique<DigCycle>(model, *plan);
}

}  // namespace

std::unique_ptr<Operator> ReadOperator(const ConfigMap& config, const MachineModel& model,
                                       const OperatorStream& stream) {
  const std::string type = ChoiceOfKeys(
      config, "type",
      {"idle", "lever_replay", "twist_replay", "waypoints", "dig_cycle", "random_levers"});
  if (IsUnread(config)) return std::make_unique<Idle>();
  if (type == "lever_replay") return ReadLeverReplay(config, model);
  if (type == "twist_replay") return ReadTwistReplay(config, model);
  if (type == "waypoints") return ReadWaypointDriver(config, model);
  if (type == "dig_cycle") return ReadDigCycle(config, model);
  if (type == "random_levers") return ReadRandomLevers(config, model, stream);
  return std::make_unique<Idle>();
}

}  // namespace tera
