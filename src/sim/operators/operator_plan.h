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

/// Leaves every lever neutral.
struct IdlePlan {};

/// A machine's operator as described in a scenario, constant during runs. MakeOperator creates an
/// operator for each run. A new kind needs an entry here and its name in ReadOperatorPlan.
using OperatorPlan = std::variant<IdlePlan, LeverReplayPlan, TwistReplayPlan, WaypointPlan, DigPlan,
                                  RandomLeversPlan>;

/// Reads a machine's `operator:` mapping. `type` is one of idle, lever_replay, twist_replay,
/// waypoints, dig_cycle, dig_to_design, random_levers. Faults (a joint or lever the machine lacks,
/// an unreadable file) go to `config`.
OperatorPlan ReadOperatorPlan(const ConfigMap& config, const MachineModel& model);

/// An operator in its initial state.
std::unique_ptr<Operator> MakeOperator(const OperatorPlan& plan, const MachineModel& model,
                                       const OperatorStream& stream);

/// The levers that a plan replays: a row for each possible change, a column for each lever of the
/// model. Empty for operators that react to the machine.
CommandTable ReplayedLevers(const OperatorPlan& plan, const MachineModel& model);

}  // namespace tera
