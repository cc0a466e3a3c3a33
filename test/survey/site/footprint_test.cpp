#include "survey/site/footprint.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

TEST(Footprint, OfATurnedRectangleIsTheRectangle) {
  // Sides 5 and 2 along (0.8, 0.6) and (-0.6, 0.8) about (10, -3).
  const Vec2 along(0.8, 0.6), across(-0.6, 0.8), middle(10, -3);
  std::vector<Vec2> places;
  for (double u = -2.5; u <= 2.5; u += 0.5) {
    for (double v = -1; v <= 1; v += 0.5) places.push_back(middle + u * along + v * across);
  }
  const Footprint found = LeastRectangle(places);
  EXPECT_NEAR((found.middle_m - middle).norm(), 0, 1e-12);
  EXPECT_NEAR(found.length_m, 5, 1e-12);
  EXPECT_NEAR(found.width_m, 2, 1e-12);
  EXPECT_NEAR(found.yaw_rad, std::atan2(0.6, 0.8), 1e-12);
  EXPECT_TRUE(found.Holds(middle + 2.4 * along + 0.9 * across));
  EXPECT_FALSE(found.Holds(middle + 2.6 * along));
  EXPECT_TRUE(found.Holds(middle + 2.6 * along, 0.2));
}

TEST(Footprint, OfOnePlaceAndOfALineAreThese) {
  EXPECT_EQ(LeastRectangle({{3, 4}}).length_m, 0);
  const Footprint line = LeastRectangle({{0, 0}, {1, 1}, {2, 2}});
  EXPECT_NEAR(line.length_m, 2 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(line.width_m, 0, 1e-12);
  EXPECT_NEAR(line.yaw_rad, 45 * kDeg, 1e-12);
}

}  // namespace
}  // namespace tera
