#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/check.h"

namespace tera {

/// The value below which the fraction `share` of the values lies. Interpolates linearly between
/// samples; for integers, the interpolated offset is truncated. `values` must not be empty.
template <typename T>
T Quantile(std::vector<T> values, double share) {
  TERA_CHECK(!values.empty());
  TERA_CHECK(share >= 0 && share <= 1, share);
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), nth, values.end());
  if (below + 1 == values.size()) return *nth;
  const T next = *std::min_element(nth + 1, values.end());
  const double rest = place - static_cast<double>(below);
  if constexpr (std::is_integral_v<T>) {
    return *nth + static_cast<T>(rest * static_cast<double>(next - *nth));
  } else {
    return std::lerp(*nth, next, static_cast<T>(rest));
  }
}

template <typename T>
T Median(std::vector<T> values) {
  return Quantile(std::move(values), 0.5);
}

}  // namespace tera
