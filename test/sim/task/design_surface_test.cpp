#include "sim/task/design_surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

constexpr double kClose_m = 1e-9;

/// A floor of 4 x 2 m about (10, 5), turned by the angle of a 3-4-5 triangle.
DesignSurface TurnedFloor() {
  const Vec2 along(0.8, 0.6), across(-0.6, 0.8), middle(10, 5);
  return {.corners_W_m = {middle - 2 * along - across, middle + 2 * along - across,
                          middle + 2 * along + across, middle - 2 * along + across},
          .at_W_m = middle,
          .floor_m = -1.5};
}

TEST(DesignSurface, OfUprightSidesIsTheFloorAndEndsAtItsEdge) {
  const DesignSurface pit = TurnedFloor();
  EXPECT_NEAR(*pit.HeightAt({10, 5}), -1.5, kClose_m);
  EXPECT_NEAR(*pit.HeightAt(Vec2(10, 5) + 1.99 * Vec2(0.8, 0.6)), -1.5, kClose_m);
  EXPECT_FALSE(pit.HeightAt(Vec2(10, 5) + 2.01 * Vec2(0.8, 0.6)));
  EXPECT_FALSE(pit.HeightAt(Vec2(10, 5) + 1.01 * Vec2(-0.6, 0.8)));
}

TEST(DesignSurface, RisesFromAnEdgeBySideSlopeAndFromACornerAsACone) {
  DesignSurface pit = TurnedFloor();
  pit.side_rad = std::atan2(2, 1);  // one metre out, two up
  const Vec2 along(0.8, 0.6), across(-0.6, 0.8), middle(10, 5);
  EXPECT_NEAR(*pit.HeightAt(middle + 1.5 * across), -1.5 + 2 * 0.5, kClose_m);
  const Vec2 beyond_corner = middle + 2.3 * along + 1.4 * across;  // 0.3 and 0.4 m: 0.5 m
  EXPECT_NEAR(*pit.HeightAt(beyond_corner), -1.5 + 2 * 0.5, kClose_m);
}

TEST(DesignSurface, FallsWithItsGrade) {
  DesignSurface drain = TurnedFloor();
  drain.grade = Vec2(0.02, -0.01);
  EXPECT_NEAR(*drain.HeightAt({11, 5.5}), -1.5 + 0.02 - 0.005, kClose_m);
}

TEST(DesignSurface, OfAFloorWithANotchLeavesTheNotchOut) {
  const DesignSurface yard{.corners_W_m = {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}, .floor_m = -1};
  EXPECT_TRUE(yard.HeightAt({0.5, 2}));
  EXPECT_TRUE(yard.HeightAt({3.5, 2}));
  EXPECT_FALSE(yard.HeightAt({2, 2}));
}

TEST(DesignSurface, TellsHowFarAPlaceIsFromItsEdge) {
  const DesignSurface pit = TurnedFloor();
  const Vec2 across(-0.6, 0.8);
  EXPECT_NEAR(pit.InsideBy_m(Vec2(10, 5) + 0.75 * across), 0.25, kClose_m);
  EXPECT_NEAR(pit.InsideBy_m(Vec2(10, 5) - 1.75 * across), -0.75, kClose_m);
}

}  // namespace
}  // namespace tera
