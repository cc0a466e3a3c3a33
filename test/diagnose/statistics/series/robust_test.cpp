#include "diagnose/statistics/series/robust.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

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

TEST(Quantile, LiesStraightBetweenTheTwoValuesNextToItsShare) {
  const std::vector<double> unsorted = {40, 10, 30, 20};
  EXPECT_DOUBLE_EQ(Quantile(unsorted, 0), 10);
  EXPECT_DOUBLE_EQ(Quantile(unsorted, 1), 40);
  EXPECT_DOUBLE_EQ(Quantile(unsorted, 0.25), 17.5);  // three quarters of the way from 10 to 20
  EXPECT_DOUBLE_EQ(Median(unsorted), 25);
  EXPECT_DOUBLE_EQ(Median({7}), 7);
}

}  // namespace
}  // namespace tera
