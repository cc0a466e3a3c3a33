#pragma once

#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Stamps recorded poses when they were measured, where the estimate names their clock as late (or
/// early) and nothing that might be it instead: a base that is replayed over late poses would be
/// told the same cause once more. Returns whether any stamp has changed.
bool StampPosesAnew(const SensorDiagnosis& estimate, Measurements* measured);

}  // namespace tera
