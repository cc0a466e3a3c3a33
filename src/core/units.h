#pragma once

/// Constants of nature and of notation. Everything inside the program is SI with radians; degrees
/// exist only in YAML keys and report text that end in `_deg`.

namespace tera {

inline constexpr double kPi = 3.14159265358979323846;
/// Radians in a degree: `angle_rad = angle_deg * kDeg`.
inline constexpr double kDeg = kPi / 180.0;
/// Standard gravity, ISO 80000-3.
inline constexpr double kStandardGravity_mps2 = 9.80665;
/// The unit in which data sheets state the noise of accelerometers.
inline constexpr double kMicroG_mps2 = 1e-6 * kStandardGravity_mps2;

}  // namespace tera
