#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/measurement.h"

/// How a kind of sensor that measures ranges is compared with a scene: what its rays are, and which
/// points a measurement has.

namespace tera {

struct SensorDescription;

/// One measured return, in the sensor's frame S at its own time.
struct RangePoint {
  Vec3 p_S_m = Vec3::Zero();
  TimeNs since_ns = 0;  ///< after the scan's t_ns
  double sigma_m = 0;   ///< of its noise along the ray, as the sensor's model has it
};

struct RangeScan {
  TimeNs t_ns = 0;  ///< as written on it
  std::vector<RangePoint> points;
};

/// A scan of a recording, or why it cannot be compared with the scenario's sensor.
struct LoadedScan {
  RangeScan scan;
  std::string obstacle;  ///< empty where there is none
};

/// What a sensor that measures ranges says of itself.
struct Ranging {
  double min_range_m = 0, max_range_m = 0;
  bool is_planar = false;  ///< it reports x of a point in S, not its distance
  TimeNs span_ns = 0;      ///< of the rays of one measurement; 0: all at one instant
  int scene_poses = 1;     ///< instants of the span at which the bodies of a scene are posed
  /// The points of a measurement in S as documented, some `most` of them. Noise is that of the
  /// sensor's model.
  LoadedScan (*points)(const SensorDescription& sensor, const Measurement& recorded,
                       std::size_t most) = nullptr;
};

}  // namespace tera
