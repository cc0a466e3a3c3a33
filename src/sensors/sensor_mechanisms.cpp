#include "sensors/sensor_mechanisms.h"

namespace tera {

std::span<const Mechanism> SensorMechanisms() { return {}; }

}  // namespace tera
