#pragma once

#include <string>

#include "dataset/format/recording.h"
#include "sensors/ranging.h"
#include "sensors/sensor.h"

namespace tera {

/// Loads one scan or depth image of a ranging sensor (SensorKind::ranging), thinned to about 4000
/// points. Points are in S, the documented sensor frame. Throws InputError for a malformed file.
LoadedScan LoadRangeScan(const Recording& recording, const std::string& channel,
                         const SensorDescription& sensor, TimeNs t_ns);

/// Brightness of a recorded image, or the reason why it cannot be compared with the scenario's
/// sensor.
struct LoadedPicture {
  Image<float> grey;     ///< in [0, 1]
  std::string obstacle;  ///< the reason; empty if the image is comparable
};

/// Loads an image and reduces it by the factor `reduced` along both axes. Throws InputError for a
/// malformed file.
LoadedPicture LoadGreyPicture(const Recording& recording, const std::string& channel,
                              const SensorDescription& sensor, TimeNs t_ns, int reduced);

}  // namespace tera
