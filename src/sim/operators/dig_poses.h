#pragma once

#include "core/units.h"

/// Bucket poses that all kinds of digging share.

namespace tera::dig {

// Height of the tip above the ground before it is lowered, in bucket lengths.
inline constexpr double kClearance = 0.58;
// distance by which the carried load is nearer to the slew axis than the dump place
inline constexpr double kCarryInside_m = 1.6;
// height of the carried load above the dump place
inline constexpr double kCarryAbove_m = 0.2;
// Pitch of the direction from the bucket's pin to its tip.
inline constexpr double kEntryPitch_rad = -75 * kDeg;
inline constexpr double kCutEndPitch_rad = -112 * kDeg;
inline constexpr double kCarryPitch_rad = -188 * kDeg;
inline constexpr double kDumpPitch_rad = -60 * kDeg;

/// Travel that a cut in a trench spends on sinking to its depth before it moves inwards.
inline constexpr double kPlunge_m = 0.25;

inline double Mix(double a, double b, double s) { return a + (b - a) * s; }

}  // namespace tera::dig
