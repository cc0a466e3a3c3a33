#pragma once

#include <string>

#include "dataset/format/recording.h"
#include "sensors/ranging.h"
#include "sensors/sensor.h"

namespace tera {

/// Loads one measurement of a sensor that measures ranges (SensorKind::ranging), thinned to some
/// 4000 points in S as documented. Throws InputError where the file is not as it must be.
LoadedScan LoadRangeScan(const Recording& recording, const std::string& channel,
                         const SensorDescription& sensor, TimeNs t_ns);

/// The brightness of a recorded picture, or why it cannot be compared with the scenario's sensor.
struct LoadedPicture {
  Image<float> grey;     ///< 0 to 1
  std::string obstacle;  ///< empty where there is none
};

/// Loads the picture of a sensor that takes pictures, `reduced` times smaller in both directions.
/// Throws InputError where the file is not as it must be.
LoadedPicture LoadGreyPicture(const Recording& recording, const std::string& channel,
                              const SensorDescription& sensor, TimeNs t_ns, int reduced);

}  // namespace tera
