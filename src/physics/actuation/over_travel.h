#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace tera {

/// A quantity as a function of a joint's position: one constant, or values at equal steps from the
/// first to the last position. Linear between them, constant outside.
struct OverTravel {
  double first_rad = 0, last_rad = 0;
  std::vector<double> values;  ///< must not be empty when evaluated

  double At(double position_rad) const {
    if (values.size() < 2) return values.front();
    const double last = static_cast<double>(values.size() - 1);
    const double travelled = (position_rad - first_rad) / (last_rad - first_rad);
    const double place = std::clamp(travelled * last, 0.0, last);
    const auto below = std::min(static_cast<std::size_t>(place), values.size() - 2);
    return std::lerp(values[below], values[below + 1], place - static_cast<double>(below));
  }
};

}  // namespace tera
