#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"
#include "diagnose/replay/pump_demand.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The candidates that the rate of a joint or gear can show: mechanisms of command_timing,
/// lever_map, actuator, kinematic_gain and load_friction, and of flow of the pump that feeds the
/// axis, where the axis and another of the pump's functions were driven together for long enough.
/// Bounds and starts follow from the log: rates up to the axis's full one, loads up to the largest
/// seen, swings up to the Nyquist frequency of the samples. A mechanism that the model has already
/// may have wrong numbers. `measured` are the samples that are new measurements, of one sensor.
///
/// Omits   friction and payload, against both of which a motor that is given a rate keeps it, so
///         that they show in no rate but through pressure_droop.
std::vector<Candidate> CandidatesOfAxis(const MachineModel& model, const AxisLog& log,
                                        const MeasuredRate& measured,
                                        const std::optional<PumpDemand>& pump);

/// The loss of its commands, `command_drops`, whose times a replay does not know.
std::vector<Candidate> LossOfAxis(const MachineModel& model, std::size_t axis);

}  // namespace tera
