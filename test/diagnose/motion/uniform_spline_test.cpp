#include "diagnose/motion/uniform_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/random.h"

// A cubic B-spline reproduces polynomials: sum_i B(x - i) of i, i^2 - 1/3 and i^3 - i gives x, x^2
// and x^3 (its second moment is 1/3, Marsden's identity).

namespace tera {
namespace {

const UniformSpline kSpline = {.step_s = 0.2, .coefficients = 16};

/// One row of weights, a derivative, over coefficients.
double Apply(const SplineWeights& weights, int derivative, const std::vector<double>& c) {
  double sum = 0;
  for (int k = 0; k < 5; ++k) {
    const double weight = weights.by_derivative(derivative, k);
    const int i = weights.first + k;
    if (i < 0 || i >= static_cast<int>(c.size())) {
      EXPECT_EQ(weight, 0) << "coefficient " << i << " is not there";
      continue;
    }
    sum += weight * c[i];
  }
  return sum;
}

std::vector<double> Coefficients(const std::function<double(double)>& of_place) {
  std::vector<double> c;
  for (int i = 0; i < kSpline.coefficients; ++i) c.push_back(of_place(i - 1));
  return c;
}

std::vector<double> RandomCoefficients(std::uint64_t seed) {
  const Stream draw(seed, "coefficients");
  std::vector<double> c;
  for (int i = 0; i < kSpline.coefficients; ++i) c.push_back(draw.Gaussian(i));
  return c;
}

/// 300 times from start to end, both included, and every knot.
std::vector<double> Times() {
  std::vector<double> times;
  for (int k = 0; k <= 300; ++k) times.push_back(kSpline.end_s() * k / 300);
  for (int k = 0; k <= kSpline.coefficients - 3; ++k) times.push_back(k * kSpline.step_s);
  return times;
}

TEST(UniformSpline, WeightsOfAValueSumToOneAndThoseOfDerivativesToNothing) {
  for (const double t : Times()) {
    const SplineWeights at = kSpline.At(t);
    EXPECT_NEAR(at.by_derivative.row(0).sum(), 1, 1e-12) << t;
    for (int d = 1; d < 4; ++d) {
      EXPECT_NEAR(at.by_derivative.row(d).sum(), 0, 1e-12 / std::pow(kSpline.step_s, d)) << t;
    }
    EXPECT_GE(at.by_derivative.row(0).minCoeff(), -1e-12);
  }
}

TEST(UniformSpline, WeighsTheNeighboursOfAKnotByASixthAndItselfByTwoThirds) {
  for (int k = 0; k <= kSpline.coefficients - 3; ++k) {
    const SplineWeights at = kSpline.At(k * kSpline.step_s);
    for (int i = 0; i < kSpline.coefficients; ++i) {
      std::vector<double> one(kSpline.coefficients, 0.0);
      one[i] = 1;
      const double expected = i == k + 1 ? 2.0 / 3 : i == k || i == k + 2 ? 1.0 / 6 : 0;
      EXPECT_NEAR(Apply(at, 0, one), expected, 1e-12) << "knot " << k << ", coefficient " << i;
    }
  }
}

TEST(UniformSpline, HasCubicsWithAllTheirDerivatives) {
  const double h = kSpline.step_s;
  const std::vector<double> c = Coefficients([&](double x) {
    return 2 - x * h + 0.7 * (x * x - 1.0 / 3) * h * h + 0.3 * (x * x * x - x) * h * h * h;
  });
  for (const double t : Times()) {
    const SplineWeights at = kSpline.At(t);
    EXPECT_NEAR(Apply(at, 0, c), 2 - t + 0.7 * t * t + 0.3 * t * t * t, 1e-11) << t;
    EXPECT_NEAR(Apply(at, 1, c), -1 + 1.4 * t + 0.9 * t * t, 1e-10) << t;
    EXPECT_NEAR(Apply(at, 2, c), 1.4 + 1.8 * t, 1e-9) << t;
    EXPECT_NEAR(Apply(at, 3, c), 1.8, 1e-8) << t;
  }
}

TEST(UniformSpline, HasDerivativesThatAreLimitsOfDifferencesOfTheOneBefore) {
  const std::vector<double> c = RandomCoefficients(1);
  const double step = 1e-5;
  for (int k = 1; k < 200; ++k) {
    const double t = kSpline.end_s() * (k + 0.317) / 201;
    for (int d = 0; d < 3; ++d) {
      const double difference =
          (Apply(kSpline.At(t + step), d, c) - Apply(kSpline.At(t - step), d, c)) / (2 * step);
      EXPECT_NEAR(Apply(kSpline.At(t), d + 1, c), difference, 1e-4 * std::pow(5.0, d + 1)) << t;
    }
  }
}

/// The mean of a derivative by ten thousand middles of intervals.
double MeanByRectangles(const std::vector<double>& c, int d, double from, double to) {
  double sum = 0;
  for (int k = 0; k < 10000; ++k)
    sum += Apply(kSpline.At(from + (to - from) * (k + 0.5) / 1e4), d, c);
  return sum / 1e4;
}

TEST(UniformSpline, HasMeansOfDerivativesAsRectanglesSumThem) {
  const std::vector<double> c = RandomCoefficients(2);
  const double h = kSpline.step_s, end = kSpline.end_s();
  // Within a step, over a knot, over a whole step, at both ends.
  const double spans[][2] = {
      {0.41, 0.55},      {0.33, 0.48},           {1.3, 1.3 + h},    {0, 0.1},      {0, h},
      {end - 0.07, end}, {end - 0.999 * h, end}, {0.4, 0.4 + 1e-3}, {0.599, 0.601}};
  for (const auto& [from, to] : spans) {
    const SplineWeights mean = kSpline.MeanOver(from, to);
    for (int d = 1; d < 4; ++d) {
      const double expected = MeanByRectangles(c, d, from, to);
      EXPECT_NEAR(Apply(mean, d, c), expected, 3e-3 * std::pow(5.0, d - 1))
          << "derivative " << d << " from " << from << " to " << to;
    }
    // The error of Simpson's rule is at most |jump| h^3 / 324 for a jump of the third derivative at
    // a knot. Coefficients of size 1 allow a jump of some 10 / h^3.
    EXPECT_NEAR(Apply(mean, 0, c), MeanByRectangles(c, 0, from, to), 0.03) << from << " " << to;
  }
}

TEST(UniformSpline, HasMeansOfDerivativesThatAreDifferencesOfValuesExactly) {
  const std::vector<double> c = RandomCoefficients(3);
  const Stream draw(4, "spans");
  for (int k = 0; k < 300; ++k) {
    const double from = draw.Uniform(k) * (kSpline.end_s() - kSpline.step_s);
    const double to = from + kSpline.step_s * (0.01 + 0.99 * draw.Uniform(k, 1));
    const SplineWeights mean = kSpline.MeanOver(from, to);
    for (int d = 0; d < 3; ++d) {
      const double rise = Apply(kSpline.At(to), d, c) - Apply(kSpline.At(from), d, c);
      EXPECT_NEAR(Apply(mean, d + 1, c) * (to - from), rise, 1e-9 * std::pow(25.0, d))
          << from << " " << to;
    }
    EXPECT_NEAR(mean.by_derivative.row(0).sum(), 1, 1e-12);
  }
}

TEST(UniformSpline, HasMeansOfCubicsWithinAStepExactly) {
  const double h = kSpline.step_s;
  const std::vector<double> c =
      Coefficients([&](double x) { return (x * x * x - x) * h * h * h; });  // t^3
  const double from = 0.63, to = 0.78;
  const double mean = (std::pow(to, 4) - std::pow(from, 4)) / 4 / (to - from);
  EXPECT_NEAR(Apply(kSpline.MeanOver(from, to), 0, c), mean, 1e-12);
}

TEST(UniformSpline, OverMoreThanAStepIsThatOfTheMiddle) {
  const std::vector<double> c = RandomCoefficients(5);
  const SplineWeights mean = kSpline.MeanOver(0.31, 1.17), middle = kSpline.At(0.74);
  for (int d = 0; d < 4; ++d) EXPECT_NEAR(Apply(mean, d, c), Apply(middle, d, c), 1e-9) << d;
}

// 0.5 - 0.24999999999999997 rounds to no more than a step of 0.25, but touches three.
TEST(UniformSpline, OverAStepFromJustBeforeAKnotIsAsFromTheKnot) {
  const UniformSpline spline = {.step_s = 0.25, .coefficients = 16};
  const std::vector<double> c = RandomCoefficients(7);
  const SplineWeights before = spline.MeanOver(std::nextafter(0.25, 0), 0.5),
                      at = spline.MeanOver(0.25, 0.5);
  for (int d = 0; d < 4; ++d) {
    EXPECT_NEAR(before.by_derivative.row(d).sum(), d == 0 ? 1 : 0, 1e-9) << d;
    EXPECT_NEAR(Apply(before, d, c), Apply(at, d, c), 0.5 * std::pow(10.0, d)) << d;
  }
}

TEST(UniformSpline, OverNoTimeIsThatOfTheTime) {
  const std::vector<double> c = RandomCoefficients(6);
  for (const double t : {0.0, 0.4, 0.73, kSpline.end_s()}) {
    const SplineWeights mean = kSpline.MeanOver(t, t), at = kSpline.At(t);
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(Apply(mean, d, c), Apply(at, d, c), 1e-9) << t << d;
    EXPECT_TRUE(mean.by_derivative.allFinite()) << t;
  }
}

TEST(UniformSpline, CoversFromItsFirstToItsLastKnotAndNoFurther) {
  EXPECT_NEAR(kSpline.end_s(), 2.6, 1e-12);
  EXPECT_TRUE(kSpline.Covers(0, kSpline.end_s()));
  EXPECT_FALSE(kSpline.Covers(-1e-9, 1));
  EXPECT_FALSE(kSpline.Covers(1, kSpline.end_s() + 1e-9));
}

TEST(UniformSpline, OfASingleStepUsesItsFourCoefficientsOnly) {
  const UniformSpline shortest = {.step_s = 0.1, .coefficients = 4};
  for (const double t : {0.0, 0.05, shortest.end_s()}) {
    const SplineWeights at = shortest.At(t), mean = shortest.MeanOver(0, t);
    for (const SplineWeights& weights : {at, mean}) {
      ASSERT_GE(weights.first, 0);
      for (int k = 0; k < 5; ++k) {
        if (weights.first + k >= 4) {
          EXPECT_EQ(weights.by_derivative.col(k).norm(), 0) << t;
        }
      }
    }
  }
}

}  // namespace
}  // namespace tera
