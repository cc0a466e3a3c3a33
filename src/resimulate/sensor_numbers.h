#pragma once

#include <array>

#include "core/motion.h"

namespace tera {

/// Numbers of the mechanisms that act on a whole sensor, named as in effects.yaml, in radians.
///
/// Frames  B link, S sensor as documented, T as it is: p_BT = p_BS + shift_B, R_BT = R_BS R(rpy).
/// Model   reported range (of a depth camera: depth) = factor * true + range_m; reported time =
///         true + offset_s.
struct SensorNumbers {
  static constexpr int kCount = 9;
  enum Index { kX, kY, kZ, kRoll, kPitch, kYaw, kRange, kFactor, kOffset };
  std::array<double, kCount> value = {0, 0, 0, 0, 0, 0, 0, 1, 0};

  Vec3 shift_B_m() const { return {value[kX], value[kY], value[kZ]}; }
  Mat3 R_ST() const { return RotationFromRpy(value[kRoll], value[kPitch], value[kYaw]); }
};

}  // namespace tera
