#pragma once

#include <string>
#include <vector>

#include "diagnose/sensors/diagnosed_sensors.h"

namespace tera {

/// The sensors that were compared with each other, once each: "imu boom".
std::vector<std::string> ComparedSensors(const DiagnosedSensors& sensors);

/// Sentences on faults of units, receivers, encoders and poses.
std::vector<std::string> SensorSentences(const DiagnosedSensors& sensors);

/// Sentences on significant findings within tolerance, on indistinguishable ones, and on sensors
/// that were not compared, with the reason.
std::vector<std::string> OtherSensorSentences(const DiagnosedSensors& sensors);

}  // namespace tera
