#pragma once

#include <string>
#include <vector>

#include "diagnose/sensors/diagnosed_sensors.h"

namespace tera {

/// The sensors that were compared with each other, once each: "imu boom".
std::vector<std::string> ComparedSensors(const DiagnosedSensors& sensors);

/// Sentences on what is wrong with units, receivers, encoders and poses.
std::vector<std::string> SensorSentences(const DiagnosedSensors& sensors);

/// A sentence on what of them is significant and within tolerance, one on what is not told apart;
/// what was not compared, with the reason.
std::vector<std::string> OtherSensorSentences(const DiagnosedSensors& sensors);

}  // namespace tera
