#pragma once

#include <optional>
#include <vector>

#include "diagnose/recorded_blocks.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Time by which encoders run ahead of the levers that move their joints. No joint moves before its
/// command, so a lead shows that the clocks differ.
///
/// Model   for each joint or track with a lever, the shift of its rate, up to 0.5 s, at which the
///         scenario's predicted rate explains most of it. It is a lead if it exceeds 0.04 s,
///         explains at least half and leaves at most half of the unshifted prediction's residual.
///         The result is the mean, if at least two encoders move and all agree within a quarter.
/// Omits   clocks that drift; a lead of single joints.
std::optional<double> EncoderLead_s(const std::vector<ReplayBlock>& blocks);

/// Moves encoder stamps to the times of measurement, if the estimate names their clock without
/// rivals and the levers confirm it. Otherwise each joint would seem to have a delay too.
///
/// Model   among sensors alone, late encoders are equivalent to all other sensors being early.
///         Levers decide: rates of joints and gears as predicted by the scenario, with a factor and
///         white noise of any size, are jointly likelier at the times of one clock than of the
///         other. Stamps stay if the levers share the encoders' clock, or if levers do not decide.
/// Omits   delays of drives, which make the later stamps likelier.
///
/// Returns whether any stamp has changed.
bool StampEncodersAnew(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                       const BlockOptions& options, Measurements* measured);

}  // namespace tera
