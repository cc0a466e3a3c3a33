#pragma once

#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// Effect of `scale` and `range_bias` on a true distance r of a lidar or depth camera: factor r +
/// bias_m.
struct RangeScaling {
  double factor = 1;
  double bias_m = 0;
};
RangeScaling RangeScalingOf(const Effects& effects);

/// Errors `sensor_static` of distance sensors: ranges of a lidar, depths of a camera.
///
/// Model   m r + b + c dT(t) + o, rounded to a multiple of the step. m comes from `scale`, b from
///         `range_bias`, c dT(t) from `temperature_drift` (lidar). o comes from `outliers`: N(0,
///         size^2) for each point or pixel with the given probability. `quantisation` rounds. A
///         point keeps its direction. A result of zero or less removes the measurement.
/// Omits   Errors of single beams or image regions; colour.
class RangeErrors {
 public:
  RangeErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// Applies the errors to scan or frame `k`.
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
