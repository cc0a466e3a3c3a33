#pragma once

#include "diagnose/recorded_blocks.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Stamps encoders when they measured, where the estimate names their clock and nothing that might
/// be it instead, and the levers bear it out: else each joint would be told to answer late as well.
///
/// Model   against the sensors alone an encoder that is late is the same as all others that are
///         early. Levers tell: rates of joints and gears as the scenario predicts them, with a
///         factor and white noise of any size, are likelier at the times of one clock than of the
///         other, all together. Where the levers share the encoders' clock, or say nothing, stamps
///         stay.
/// Omits   delays of drives, which make the later stamps likelier.
/// Returns whether any stamp has changed.
bool StampEncodersAnew(const DiagnosisInput& input, const SensorDiagnosis& estimate,
                       const BlockOptions& options, Measurements* measured);

}  // namespace tera
