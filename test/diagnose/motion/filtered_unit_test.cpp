#include "diagnose/motion/filtered_unit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kEvery_s = 0.01;

FilteredUnit::Rows Sampled(double (*of)(double), int count = 400) {
  FilteredUnit::Rows rows(6, count);
  for (int k = 0; k < count; ++k) rows.col(k).setConstant(of(k * kEvery_s));
  return rows;
}

double Ramp(double t) { return 2 * t; }

TEST(FilteredUnit, IsBehindARampByItsTimeConstant) {
  const FilteredUnit filtered(kEvery_s, 0.16, Sampled(Ramp), Sampled(Ramp));
  for (const int k : {0, 1, 10, 399}) {
    EXPECT_NEAR(filtered.value(2, k), Ramp(k * kEvery_s - 0.16), 1e-12) << k;
    EXPECT_NEAR(filtered.by_time_constant(2, k), -2, 1e-9) << k;
  }
}

// T y' = 2 (t - 1) - y from 0 at t = 1 has the solution 2 (u - T + T exp(-u / T)), u = t - 1.
TEST(FilteredUnit, OfARampThatBeginsIsItsClosedForm) {
  const double T = 0.16;
  const auto rows = Sampled([](double t) { return std::max(0.0, Ramp(t - 1)); });
  const FilteredUnit filtered(kEvery_s, T, rows, rows);
  for (const int k : {50, 101, 130, 399}) {
    const double u = std::max(0.0, k * kEvery_s - 1);
    EXPECT_NEAR(filtered.value(2, k), 2 * (u - T + T * std::exp(-u / T)), 1e-12) << k;
  }
}

// sin(w t) settles to sin(w t - atan(w T)) / sqrt(1 + (w T)^2).
TEST(FilteredUnit, WeakensAndDelaysASine) {
  const double T = 0.16, w = 5;
  const auto sine = Sampled([](double t) { return std::sin(5 * t); });
  const FilteredUnit filtered(kEvery_s, T, sine, sine);
  for (int k = 200; k < 400; k += 7) {
    const double t = k * kEvery_s;
    EXPECT_NEAR(filtered.value(0, k), std::sin(w * t - std::atan(w * T)) / std::hypot(1, w * T),
                1e-3)
        << k;
  }
}

TEST(FilteredUnit, HasTheDerivativeByItsTimeConstant) {
  const double T = 0.1, h = 1e-5;
  const auto x = Sampled([](double t) { return std::sin(5 * t) + 0.3 * t; });
  const FilteredUnit less(kEvery_s, T - h, x, x), more(kEvery_s, T + h, x, x),
      at(kEvery_s, T, x, x);
  for (int k = 0; k < 400; k += 13) {
    // The derivative is filtered as linear between instants, which it is not quite.
    EXPECT_NEAR(at.by_time_constant(5, k), (more.value(5, k) - less.value(5, k)) / (2 * h), 0.01)
        << k;
  }
}

TEST(FilteredUnit, IsTheInputForShortTimeConstants) {
  const FilteredUnit filtered(kEvery_s, 1e-5, Sampled(Ramp), Sampled(Ramp));
  EXPECT_NEAR(filtered.value(0, 100), Ramp(1), 1e-4);
}

TEST(FilteredUnit, AveragesOverATime) {
  const FilteredUnit filtered(kEvery_s, 1e-5, Sampled(Ramp), Sampled(Ramp));
  EXPECT_NEAR(filtered.MeanOver(filtered.value, 1.02, 1.07)[3], Ramp(1.045), 1e-4);
  EXPECT_NEAR(filtered.MeanOver(filtered.value, 50, 51)[3], Ramp(3.99), 1e-4);
}

}  // namespace
}  // namespace tera
