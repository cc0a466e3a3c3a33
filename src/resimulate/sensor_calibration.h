#pragma once

#include "core/motion.h"
#include "core/types/effects.h"

namespace tera {

/// Combined effect of a sensor's mechanisms on its mount, ranges and clock.
///
/// Frames  B link, T true sensor.
/// Model   X_BT as in sensors/slots/true_mount.h. Reported range (for a depth camera, depth) =
///         range_factor * true range + range_bias_m. Time stamp = true time + clock_offset_s.
/// Omits   effects that differ between points or scans: outliers, quantisation, drift, jitter.
struct SensorCalibration {
  Pose X_BT = Pose::Identity();
  double range_factor = 1;
  double range_bias_m = 0;
  double clock_offset_s = 0;
};

/// `X_BS` is the documented mount.
SensorCalibration CalibrationUnder(const Pose& X_BS, const Effects& effects);

}  // namespace tera
