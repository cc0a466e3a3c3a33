#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"
#include "diagnose/replay/pump_demand.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The mechanisms of command_timing, lever_map, actuator, kinematic_gain and load_friction that the
/// rate of a joint or gear can show, with bounds and starts by what the log holds: rates up to the
/// axis's full one, loads up to the largest seen. What it has already may have wrong
/// numbers. Behind them those of slot flow of the pump that feeds it, where the axis and another of
/// the pump's functions were driven together for long enough.
///
/// Omits   friction and payload: a motor that asks for a rate gets it against both, so that they
///         show in no rate but through pressure_droop; command_drops, whose losses a replay does
///         not know.
std::vector<Candidate> CandidatesOfAxis(const MachineModel& model, const AxisLog& log,
                                        std::size_t axis, const std::optional<PumpDemand>& pump);

}  // namespace tera
