#pragma once

#include <string>

#include "dataset/format/recording.h"
#include "resimulate/range_scan.h"
#include "sensors/sensor.h"

namespace tera {

/// A scan of a recording, or why it cannot be compared with the scenario's sensor.
struct LoadedScan {
  RangeScan scan;
  std::string obstacle;  ///< empty where there is none
};

/// Loads a lidar's scan or a camera's depth picture, thinned to some 4000 points.
///
/// Frames  S of the sensor, as documented.
/// Model   an odd number of points from one that is taken to the next, so that all beams come; of
///         pictures the points that their pixels see. Noise is that of the sensor's model.
///
/// Throws InputError where the file is not as it must be.
LoadedScan LoadRangeScan(const Recording& recording, const std::string& channel,
                         const SensorDescription& sensor, TimeNs t_ns);

/// The brightness of a recorded picture, or why it cannot be compared with the scenario's camera.
struct LoadedPicture {
  Image<float> grey;     ///< 0 to 1
  std::string obstacle;  ///< empty where there is none
};

/// Loads a camera's picture, `reduced` times smaller in both directions. Throws InputError where
/// the file is not as it must be.
LoadedPicture LoadGreyPicture(const Recording& recording, const std::string& channel,
                              const SensorDescription& sensor, TimeNs t_ns, int reduced);

}  // namespace tera
