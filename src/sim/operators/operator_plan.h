#pragma once

#include <memory>
#include <variant>

#include "core/config/config.h"
#include "sim/operators/dig_cycle.h"
#include "sim/operators/lever_replay.h"
#include "sim/operators/operator.h"
#include "sim/operators/random_levers.h"
#include "sim/operators/waypoint_driver.h"

namespace tera {

/// An operator that leaves all levers neutral.
struct IdlePlan {};

/// A machine's operator as a scenario describes it; it does not change during runs. MakeOperator
/// creates an operator from it for each run. A new kind needs an alternative here and a name in
/// ReadOperatorPlan.
using OperatorPlan = std::variant<IdlePlan, LeverReplayPlan, TwistReplayPlan, WaypointPlan, DigPlan,
                                  RandomLeversPlan>;

/// Reads a machine's `operator:` mapping. `type` is one of idle, lever_replay, twist_replay,
/// waypoints, dig_cycle, dig_to_design, random_levers. Faults go to `config`: a joint or lever that
/// the machine lacks, or an unreadable file.
OperatorPlan ReadOperatorPlan(const ConfigMap& config, const MachineModel& model);

/// Creates an operator in its initial state.
std::unique_ptr<Operator> MakeOperator(const OperatorPlan& plan, const MachineModel& model,
                                       const OperatorStream& stream);

/// Lever positions that a plan replays: one row per change, one column for each lever of the model.
/// Empty for operators that react to the machine.
CommandTable ReplayedLevers(const OperatorPlan& plan, const MachineModel& model);

}  // namespace tera
