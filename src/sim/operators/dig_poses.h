#pragma once

#include "core/units.h"

/// Poses of the bucket that digging has in common, whether in one place or along a trench.

namespace tera::dig {

inline constexpr double kClearance = 0.58;     // bucket lengths above the ground before lowering
inline constexpr double kCarryInside_m = 1.6;  // radius of the carried load, less than at the dump
inline constexpr double kCarryAbove_m = 0.2;   // height of the carried load, more than at the dump
// Pitches of the tip direction.
inline constexpr double kEntryPitch_rad = -75 * kDeg;
inline constexpr double kCutEndPitch_rad = -112 * kDeg;
inline constexpr double kCarryPitch_rad = -188 * kDeg;
inline constexpr double kDumpPitch_rad = -60 * kDeg;

/// Length of a cut along a trench that the teeth spend on going down to its depth in one place.
inline constexpr double kPlunge_m = 0.25;

inline double Mix(double a, double b, double s) { return a + (b - a) * s; }

}  // namespace tera::dig
