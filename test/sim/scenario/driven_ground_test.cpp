#include "sim/scenario/driven_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/polygon.h"
#include "core/random.h"
#include "core/units.h"

namespace tera {
namespace {

ShareRow SharesOf(std::uint64_t seed) {
  return [stream = Stream(seed, "test/driven_ground")](std::uint32_t k) {
    return stream.Uniform(0, k);
  };
}

double Heading_rad(const Vec2& from_m, const Vec2& to_m) {
  return std::atan2(to_m.y() - from_m.y(), to_m.x() - from_m.x());
}

TEST(DrivenPath, GoesOnByMetresAndTurnsNoTighterThanItMay) {
  constexpr double kTightest_m = 7;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const std::vector<Vec2> path =
        DrivenPath({-20, 3}, 0.3, kTightest_m, {-20, -20}, {20, 20}, 150, SharesOf(seed));
    ASSERT_GE(path.size(), 4u);
    EXPECT_LT((path[0] - (Vec2(-20, 3) - 12 * Vec2(std::cos(0.3), std::sin(0.3)))).norm(), 1e-9);
    EXPECT_EQ(path[1], Vec2(-20, 3));
    for (std::size_t k = 2; k + 1 < path.size(); ++k) {
      EXPECT_NEAR((path[k] - path[k - 1]).norm(), 1, 1e-9);
      const double turn_rad = std::remainder(
          Heading_rad(path[k - 1], path[k]) - Heading_rad(path[k - 2], path[k - 1]), 2 * kPi);
      EXPECT_LE(std::abs(turn_rad), 1 / kTightest_m + 1e-9);
    }
  }
}

// A machine that keeps turning never leaves; one that drives straight leaves after 40 m.
TEST(DrivenPath, EndsBeyondTheRectangleOrWhereItIsLongEnough) {
  const auto always = [](double share) { return [share](std::uint32_t) { return share; }; };
  const std::vector<Vec2> straight =
      DrivenPath({-20, 3}, 0, 7, {-20, -20}, {20, 20}, 150, always(0.5));
  EXPECT_EQ(straight.size(), 1u + 42u + 1u);
  EXPECT_LT((straight.back() - Vec2(33, 3)).norm(), 1e-9);
  const std::vector<Vec2> circle = DrivenPath({0, -7}, 0, 7, {-20, -20}, {20, 20}, 150, always(1));
  EXPECT_EQ(circle.size(), 1u + 150u + 1u);
  for (std::size_t k = 1; k <= 150; ++k) EXPECT_NEAR(circle[k].norm(), 7, 0.6);
}

TEST(PatchOutline, StaysBetweenItsRadiiAndCrossesNothing) {
  double smallest = 1e9, largest = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const std::vector<Vec2> outline = PatchOutline({4, -5}, 2, SharesOf(seed));
    EXPECT_FALSE(FirstCrossing(outline));
    for (const Vec2& corner : outline) {
      const double r_m = (corner - Vec2(4, -5)).norm();
      smallest = std::min(smallest, r_m);
      largest = std::max(largest, r_m);
    }
  }
  EXPECT_GE(smallest, 2 * 0.56);
  EXPECT_LE(largest, 2 * 1.44);
  EXPECT_LT(smallest, 2 * 0.7) << "it is no circle";
  EXPECT_GT(largest, 2 * 1.3);
}

}  // namespace
}  // namespace tera
