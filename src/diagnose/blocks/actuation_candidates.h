#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"
#include "diagnose/replay/pump_demand.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Candidates that are visible in the rate of a joint or running gear: the mechanisms of
/// command_timing, lever_map, actuator, kinematic_gain and load_friction. Flow mechanisms of the
/// axis's pump are added if the axis and another function of the pump move together for long
/// enough.
///
/// The log gives bounds and starting values: rates up to the axis's full rate, loads up to the
/// largest measured load, oscillations up to the samples' Nyquist frequency. Mechanisms that the
/// model already has stay candidates, because their parameters may be wrong. `measured` contains
/// only new measurements of one sensor.
///
/// Omits   Friction and payload: a rate-controlled motor holds its rate against both. Only
///         pressure_droop makes friction and payload visible.
std::vector<Candidate> CandidatesOfAxis(const MachineModel& model, const AxisLog& log,
                                        const MeasuredRate& measured,
                                        const std::optional<PumpDemand>& pump);

/// Candidate `command_drops`, the loss of commands at times that a replay cannot know.
std::vector<Candidate> LossOfAxis(const MachineModel& model, std::size_t axis);

}  // namespace tera
