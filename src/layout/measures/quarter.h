#pragma once

#include <array>
#include <cmath>

#include "core/units.h"

namespace tera {

/// A quarter of the directions around a machine: 45 degrees to either side of `azimuth_rad`.
struct Quarter {
  const char* name;
  double azimuth_rad;  ///< 0 is ahead; counterclockwise, seen from above

  bool Holds(double direction_rad) const {
    return std::abs(std::remainder(direction_rad - azimuth_rad, 2 * kPi)) <= 0.25 * kPi + 1e-9;
  }
};

inline constexpr std::array<Quarter, 4> kQuarters = {
    {{"ahead", 0}, {"left", 0.5 * kPi}, {"behind", kPi}, {"right", 1.5 * kPi}}};

}  // namespace tera
