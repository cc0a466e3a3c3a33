#pragma once

/// Physical constants and unit factors. Internal values use SI units and radians. Degrees occur
/// only in YAML keys and report texts, with names that end in `_deg`.

namespace tera {

inline constexpr double kPi = 3.14159265358979323846;
/// Radians in a degree: `angle_rad = angle_deg * kDeg`.
inline constexpr double kDeg = kPi / 180.0;
/// Standard gravity, ISO 80000-3.
inline constexpr double kStandardGravity_mps2 = 9.80665;
/// Micro-g, the unit of accelerometer noise in data sheets.
inline constexpr double kMicroG_mps2 = 1e-6 * kStandardGravity_mps2;

}  // namespace tera
