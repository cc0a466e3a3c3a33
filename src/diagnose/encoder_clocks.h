#pragma once

#include <optional>
#include <vector>

#include "diagnose/recorded_blocks.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Estimates the time by which encoders run ahead of the levers. No joint moves before its command,
/// so a lead shows that the clocks differ. Returns nothing without a lead.
///
/// Model   The rate of each driven joint or track is compared with the scenario's prediction,
///         shifted by up to 0.5 s. The best shift explains most of the rate's energy. The best
///         shift is a lead if it exceeds 0.04 s and explains at least half of the energy. A lead
///         must also at least halve the residual of the unshifted prediction. The result is the
///         mean over encoders. At least two encoders need an estimate, and all estimates must be
///         leads that agree within a quarter.
/// Omits   Clocks that drift; a lead of single joints.
std::optional<double> EncoderLead_s(const std::vector<ReplayBlock>& blocks);

/// Shifts encoder stamps to the times of measurement. The shift needs a finding on the encoders'
/// clock without rivals, and confirmation by the levers. Unshifted stamps would give each joint a
/// delay as well. Returns true if a stamp has changed.
///
/// Model   Sensors alone cannot distinguish late encoders from other sensors that are all early.
///         The levers decide: the rates that the scenario predicts are compared with the measured
///         rates for both clocks. The likelihood allows a factor and white noise of any size, and
///         is summed over all axes. Stamps stay unless the shift makes the likelihood larger.
/// Omits   Delays of drives, which make the later stamps likelier.
bool StampEncodersAnew(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                       const BlockOptions& options, Measurements* measured);

}  // namespace tera
