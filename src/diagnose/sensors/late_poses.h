#pragma once

#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Stamps recorded poses when they were measured, where the estimate names their clock as late (or
/// early) without a rival cause. A base replayed over late poses would otherwise report the same
/// cause again. Returns whether any stamp has changed.
bool StampPosesAnew(const SensorDiagnosis& estimate, Measurements* measured);

}  // namespace tera
