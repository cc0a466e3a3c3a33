#include "diagnose/statistics/series/robust.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/random.h"

namespace tera {
namespace {

TEST(LargestMagnitude, IsOfTheValueFarthestFromZeroOnEitherSide) {
  EXPECT_EQ(LargestMagnitude(std::array{3.0, -7.5, 5.0}), 7.5);
  EXPECT_EQ(LargestMagnitude(std::array{3.0, -7.5, 9.25}), 9.25);
  EXPECT_EQ(LargestMagnitude(std::array{-0.125}), 0.125);
}

TEST(LargestMagnitude, IsZeroWhereThereIsNothing) {
  EXPECT_EQ(LargestMagnitude(std::vector<double>{}), 0);
}

// A parabola has no third differences, and nothing joins the end of one series to the next.
TEST(WhiteNoise, IsThatOfTheNoiseOnAParabola) {
  const Stream draw(6, "noise");
  std::vector<std::vector<double>> series(2);
  for (int k = 0; k < 20000; ++k) {
    series[k / 10000].push_back((k < 10000 ? 1 : -3) + 1e-6 * k * k + 0.02 * draw.Gaussian(k));
  }
  // A median of 20000 has a standard error of 1.17 %, a third more for errors that overlap.
  EXPECT_NEAR(WhiteNoise(series), 0.02, 5 * 0.016 * 0.02);
  EXPECT_EQ(WhiteNoise({{1, 2, 4}, {}}), 0);
}

}  // namespace
}  // namespace tera
