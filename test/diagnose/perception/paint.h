#pragma once

#include <cmath>
#include <cstdint>

#include "core/random.h"

namespace tera {

/// Painted squares 0.7 m wide with soft edges, each with a different grey.
inline double PaintAt(double u_m, double v_m) {
  static const Stream paint(11, "test/paint");
  const auto square = [&](int i, int j) {
    return 0.2 + 0.6 * paint.Uniform(static_cast<std::uint64_t>((i + 500) * 1000 + j + 500));
  };
  const double x = u_m / 0.7, y = v_m / 0.7;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const auto soft = [](double t) { return 1 / (1 + std::exp(-12 * (t - 0.5))); };
  const double a = soft(x - i), b = soft(y - j);
  return (1 - b) * ((1 - a) * square(i, j) + a * square(i + 1, j)) +
         b * ((1 - a) * square(i, j + 1) + a * square(i + 1, j + 1));
}

}  // namespace tera
