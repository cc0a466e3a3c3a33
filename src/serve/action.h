#pragma once

#include <map>

#include "sim/operators/remote_operator.h"
#include "sim/scenario/scenario.h"
#include "tera/v1/simulation.pb.h"

namespace tera {

/// All levers at rest.
ControlMessage Neutral(const MachineModel& model);

/// What a step's actions ask of each machine, by the machine's index. Throws InputError for a
/// machine that is not there or is named twice, and for what FaultOf finds.
std::map<std::size_t, ControlMessage> CommandsOf(const v1::Step& step, const Scenario& scenario);

}  // namespace tera
