#pragma once

#include "diagnose/recorded_blocks.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

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
