#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tera {

/// Thousandths of an optical depth; 65535: as much, or more.
inline std::uint16_t PixelOfOpticalDepth(double depth) {
  constexpr double kPerOne = 1000, kLargest = 65535;
  return static_cast<std::uint16_t>(std::clamp(std::round(kPerOne * depth), 0.0, kLargest));
}

}  // namespace tera
