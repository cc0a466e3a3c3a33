#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/measurement.h"

/// A ranging sensor as the scenario models it, for comparison of recorded ranges with the scene.

namespace tera {

struct SensorDescription;

/// One measured return, in the sensor frame S at its own time.
struct RangePoint {
  Vec3 p_S_m = Vec3::Zero();
  TimeNs since_ns = 0;  ///< relative to the scan's t_ns
  double sigma_m = 0;   ///< modelled noise along the ray
};

struct RangeScan {
  TimeNs t_ns = 0;  ///< recorded time stamp
  std::vector<RangePoint> points;
};

/// A recorded scan, or the reason why it cannot be compared with the scenario's sensor.
struct LoadedScan {
  RangeScan scan;
  std::string obstacle;  ///< reason; empty if comparable
};

/// Ranging properties of a sensor.
struct Ranging {
  double min_range_m = 0, max_range_m = 0;
  bool is_planar = false;  ///< reports x of a point in S (depth) instead of its distance
  TimeNs span_ns = 0;      ///< time between the first and the last ray of a measurement
  int scene_poses = 1;     ///< number of body poses over this time
  /// About `most` points of a measurement, in the documented S. The noise comes from the sensor's
  /// model.
  LoadedScan (*points)(const SensorDescription& sensor, const Measurement& recorded,
                       std::size_t most) = nullptr;
};

}  // namespace tera
