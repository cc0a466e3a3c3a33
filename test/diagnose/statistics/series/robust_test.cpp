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

}  // namespace
}  // namespace tera
