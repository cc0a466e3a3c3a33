#pragma once

#include <map>

#include "sim/operators/remote_operator.h"
#include "sim/scenario/scenario.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

/// A command with all levers in neutral position.
ControlMessage Neutral(const MachineModel& model);

/// Commands of a step by machine index. Throws InputError if a machine does not exist or is
/// repeated, and for faults that FaultOf finds.
std::map<std::size_t, ControlMessage> CommandsOf(const v1::Step& step, const Scenario& scenario);

}  // namespace tera
