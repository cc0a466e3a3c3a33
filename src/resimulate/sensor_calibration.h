#pragma once

#include "core/motion.h"
#include "core/types/effects.h"

namespace tera {

/// What a sensor's effects make of its mount, its ranges and its clock, as one whole.
///
/// Frames  B link, T sensor as it is.
/// Model   X_BT of sensors/slots/true_mount.h; reported range (of a depth camera: depth) =
///         range_factor * true range + range_bias_m; written time = true time + clock_offset_s.
/// Omits   effects that differ from one point or one scan to the next: outliers, quantisation,
///         drift, jitter.
struct SensorCalibration {
  Pose X_BT = Pose::Identity();
  double range_factor = 1;
  double range_bias_m = 0;
  double clock_offset_s = 0;
};

/// `X_BS` is the documented mount.
SensorCalibration CalibrationUnder(const Pose& X_BS, const Effects& effects);

}  // namespace tera
