#pragma once

#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// Corrects the stamps of recorded poses where the estimate names their clock offset without a
/// rival. Otherwise the replay of the base would report the same cause again. Returns true if any
/// stamp changed.
bool StampPosesAnew(const SensorDiagnosis& estimate, Measurements* measured);

}  // namespace tera
