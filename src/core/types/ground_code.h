#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/time.h"

/// What the pixels of a camera's pictures of ground and distance hold.

namespace tera {

/// Index of the soil plus 1; 0: no ground of the site.
inline std::uint8_t PixelOfSoil(std::uint8_t soil) {
  return static_cast<std::uint8_t>(std::min(soil + 1, 255));
}

/// Millimetres that the surface has risen, plus 32768, at most 32.767 m up or down; 0: no ground of
/// the site.
inline std::uint16_t PixelOfRise(double risen_m) {
  constexpr double kMiddle = 32768, kPerMetre = 1000;
  return static_cast<std::uint16_t>(
      std::clamp(std::round(kMiddle + kPerMetre * risen_m), 1.0, 65535.0));
}

/// Tenths of a second since ground was touched, plus 1, at most 65534; 65535: never; 0: no ground
/// of the site.
inline std::uint16_t PixelOfAge(std::optional<TimeNs> untouched_ns) {
  constexpr TimeNs kStep_ns = kNsPerSecond / 10, kLongest = 65534, kNever = 65535;
  if (!untouched_ns) return kNever;
  return static_cast<std::uint16_t>(
      std::min((*untouched_ns + kStep_ns / 2) / kStep_ns + 1, kLongest));
}

/// Whole millimetres; 0: none, or beyond 65.535 m.
inline std::uint16_t PixelOfDistance(double distance_m) {
  constexpr double kPerMetre = 1000, kLargest = 65535;
  const double value = std::round(kPerMetre * distance_m);
  return value <= kLargest ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
}

}  // namespace tera
