#pragma once

#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// Effect of `scale` and `range_bias` on a true distance r of a lidar or depth camera:
/// factor r + bias_m.
struct RangeScaling {
  double factor = 1;
  double bias_m = 0;
};
RangeScaling RangeScalingOf(const Effects& effects);

/// Slot `sensor_static` of distance sensors: a lidar's ranges, a camera's depths.
///
/// Model   m r + b + c dT(t) + o, rounded to a multiple of the step. m: `scale`; b: `range_bias`; c
///         dT(t): `temperature_drift` (lidar); o: `outliers`, N(0, size^2) for each point or pixel
///         with the given probability; `quantisation`. A point keeps its direction. A result at or
///         below zero is no measurement.
/// Omits   errors of one beam or image region; colour.
class RangeErrors {
 public:
  RangeErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// Applies the errors to scan or frame `k` of the sensor.
  void Apply(std::int64_t k, LidarScan* scan) const;
  void Apply(std::int64_t k, CameraFrame* frame) const;

 private:
  double Report(double r_m, double warmer_k, std::uint64_t index) const;

  bool present_;
  RangeScaling scaling_;
  double drift_mpk_, outlier_m_, step_m_;
  WarmUp warm_up_;
  OutlierDraw outliers_;
};

}  // namespace tera
