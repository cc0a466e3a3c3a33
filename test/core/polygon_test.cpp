#include "core/polygon.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

using Sides = std::pair<std::size_t, std::size_t>;

TEST(Polygon, AreaIsTheSameEitherWayRound) {
  const std::vector<Vec2> triangle = {{2, 1}, {6, 1}, {3, 4}};  // 4 wide, 3 high
  EXPECT_DOUBLE_EQ(AreaOf(triangle), 6);
  EXPECT_DOUBLE_EQ(AreaOf({triangle.rbegin(), triangle.rend()}), 6);
}

TEST(Polygon, CrossingSidesAreFoundTheClosingOneToo) {
  EXPECT_FALSE(FirstCrossing({{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}}));
  EXPECT_EQ(FirstCrossing({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), Sides(0, 2));
  EXPECT_EQ(FirstCrossing({{0, 0}, {3, 1}, {3, -1}, {2, 2}}), Sides(0, 2));
  EXPECT_EQ(FirstCrossing({{0, 0}, {1, 2}, {2, -1}, {3, 1}}), Sides(1, 3));
}

TEST(Polygon, SidesThatOnlyTouchDoNotCross) {
  EXPECT_FALSE(FirstCrossing({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}));
}

}  // namespace
}  // namespace tera
