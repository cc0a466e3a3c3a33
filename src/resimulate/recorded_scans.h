#pragma once

#include <string>

#include "dataset/format/recording.h"
#include "sensors/ranging.h"
#include "sensors/sensor.h"

namespace tera {

/// Loads one measurement of a ranging sensor (SensorKind::ranging), thinned to about 4000 points in
/// the documented S. Throws InputError for a malformed file.
LoadedScan LoadRangeScan(const Recording& recording, const std::string& channel,
                         const SensorDescription& sensor, TimeNs t_ns);

/// Brightness of a recorded image, or the obstacle to its comparison with the scenario's sensor.
struct LoadedPicture {
  Image<float> grey;     ///< 0 to 1
  std::string obstacle;  ///< reason; empty if comparable
};

/// Loads the image of an imaging sensor, reduced `reduced` times in both directions. Throws
/// InputError for a malformed file.
LoadedPicture LoadGreyPicture(const Recording& recording, const std::string& channel,
                              const SensorDescription& sensor, TimeNs t_ns, int reduced);

}  // namespace tera
