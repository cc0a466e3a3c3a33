#pragma once

namespace tera {

/// Golden-section search for the minimum of a unimodal function, to 0.618^sections of the range.
template <typename F>
double WhereLeast(const F& f, double low, double high, int sections) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = f(a), at_b = f(b);
  for (int k = 0; k < sections; ++k) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low), at_a = f(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low), at_b = f(b);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace tera
