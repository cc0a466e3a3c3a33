#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"
#include "diagnose/sensors/diagnosed_sensors.h"

/// Sentences on findings of sensors, lidars and cameras.

namespace tera {

/// Sensors that were compared with each other, each once: "imu boom".
std::vector<std::string> ComparedSensors(const DiagnosedSensors& sensors);

/// "Bias x 0.1 ± 0.02 m/s² of the imu, beyond tolerance (..)."
std::string SentenceOf(const SensorFound& found);

/// "Error is left that no number of a sensor explains: imu bucket turn about y 0.11 rad/s (noise
/// 0.007 rad/s)." Empty without such errors.
std::string SentenceOfUnexplained(const std::vector<const ChannelError*>& left);

/// Sentences on significant findings within tolerance, on indistinguishable mechanisms, and on
/// sensors that were not compared, with the reason.
std::vector<std::string> OtherSensorSentences(const DiagnosedSensors& sensors);

/// "Lidar roof: range bias 0.050 ± 0.001 m (chosen with p < 0.0001, confirmed with p 0.001).
/// Held-out distance to the simulated surfaces 4.8 → 1.1 cm."
std::string SentenceOf(const PerceptionDiagnosis& diagnosis, const PerceptionFinding& found);

/// One sentence per finding. Then for each sensor: unconfirmed mechanisms, the absence of findings,
/// or the reason why it was not judged.
std::vector<std::string> PerceptionSentences(const std::vector<PerceptionDiagnosis>& sensors);

}  // namespace tera
