#include "sim/operators/operator_plan.h"

#include "core/config/config_faults.h"

namespace tera {
namespace {

class Idle : public Operator {
 public:
  std::vector<double> Levers(const OperatorView& view) override {
    return std::vector<double>(view.model.levers.size(), 0.0);
  }
};

std::unique_ptr<Operator> Make(const IdlePlan&, const MachineModel&, const OperatorStream&) {
  return std::make_unique<Idle>();
}

std::unique_ptr<Operator> Make(const LeverReplayPlan& plan, const MachineModel&,
                               const OperatorStream&) {
  return std::make_unique<LeverReplay>(plan);
}

std::unique_ptr<Operator> Make(const TwistReplayPlan& plan, const MachineModel&,
                               const OperatorStream&) {
  return std::make_unique<TwistReplay>(plan);
}

std::unique_ptr<Operator> Make(const WaypointPlan& plan, const MachineModel&,
                               const OperatorStream&) {
  return std::make_unique<WaypointDriver>(plan);
}

std::unique_ptr<Operator> Make(const DigPlan& plan, const MachineModel& model,
                               const OperatorStream&) {
  return std::make_unique<DigCycle>(model, plan);
}

std::unique_ptr<Operator> Make(const RandomLeversPlan& plan, const MachineModel& model,
                               const OperatorStream& stream) {
  return std::make_unique<RandomLevers>(plan, model, stream);
}

}  // namespace

OperatorPlan ReadOperatorPlan(const ConfigMap& config, const MachineModel& model) {
  const std::string type = ChoiceOfKeys(config, "type",
                                        {"idle", "lever_replay", "twist_replay", "waypoints",
                                         "dig_cycle", "dig_to_design", "random_levers"});
  if (IsUnread(config)) return IdlePlan{};
  if (type == "lever_replay") return ReadLeverReplay(config, model);
  if (type == "twist_replay") return ReadTwistReplay(config, model);
  if (type == "waypoints") return ReadWaypointPlan(config, model);
  if (type == "random_levers") return ReadRandomLevers(config);
  if (type == "dig_cycle" || type == "dig_to_design") {
    const bool to_design = type == "dig_to_design";
    if (const std::optional<DigPlan> plan = ReadDigPlan(config, model, to_design)) return *plan;
  }
  return IdlePlan{};  // the fault of a dig cycle is already reported
}

std::unique_ptr<Operator> MakeOperator(const OperatorPlan& plan, const MachineModel& model,
                                       const OperatorStream& stream) {
  return std::visit([&](const auto& kind) { return Make(kind, model, stream); }, plan);
}

CommandTable ReplayedLevers(const OperatorPlan& plan, const MachineModel& model) {
  const CommandTable* table = nullptr;
  if (const auto* levers = std::get_if<LeverReplayPlan>(&plan)) table = levers->table.get();
  if (const auto* twists = std::get_if<TwistReplayPlan>(&plan)) table = twists->table.get();
  CommandTable out;
  if (table == nullptr) return out;
  const std::unique_ptr<Operator> driver = MakeOperator(plan, model, {});
  const MachineState unseen;
  const TerrainSurface nowhere;
  for (const TimeNs t_ns : table->t_ns) {
    out.t_ns.push_back(t_ns);
    out.rows.push_back(driver->Levers({t_ns, model, unseen, nowhere}));
  }
  return out;
}

}  // namespace tera
