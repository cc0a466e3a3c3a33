#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"
#include "diagnose/replay/pump_demand.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Candidates that the rate of a joint or gear can show: mechanisms of command_timing, lever_map,
/// actuator, kinematic_gain and load_friction. Also of flow of the axis's pump, if the axis and
/// another of the pump's functions move together long enough. Bounds and starts follow from the
/// log: rates up to the axis's full one, loads up to the largest seen, oscillations up to the
/// samples' Nyquist frequency. Mechanisms that the model already has may have wrong parameters.
/// `measured` has the samples of one sensor that are new measurements.
///
/// Omits   friction and payload: a motor with a demanded rate keeps it against both, so that they
///         show only through pressure_droop.
std::vector<Candidate> CandidatesOfAxis(const MachineModel& model, const AxisLog& log,
                                        const MeasuredRate& measured,
                                        const std::optional<PumpDemand>& pump);

/// The loss of the axis's commands, `command_drops`, at times unknown to a replay.
std::vector<Candidate> LossOfAxis(const MachineModel& model, std::size_t axis);

}  // namespace tera
