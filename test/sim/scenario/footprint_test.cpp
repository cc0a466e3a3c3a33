#include "sim/scenario/footprint.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

TEST(Footprint, TwoMeetByTheirTurnedRectanglesNotByTheirCircles) {
  const Footprint lying{.middle_W_m = Vec2(1, 2), .yaw_rad = 0, .half_m = Vec2(3, 0.5)};
  // 1.2 m aside, along: 0.2 m apart.
  const Footprint beside{.middle_W_m = Vec2(2, 3.2), .yaw_rad = 0, .half_m = Vec2(3, 0.5)};
  EXPECT_FALSE(Meet(lying, beside, 0));
  EXPECT_FALSE(Meet(lying, beside, 0.19));
  EXPECT_TRUE(Meet(lying, beside, 0.21));
  // Rotated across, it reaches into the first.
  Footprint across = beside;
  across.yaw_rad = 90 * kDeg;
  EXPECT_TRUE(Meet(lying, across, 0));
  // At 45 deg a square of half 1 reaches sqrt(2) to the side: from y = 2.5 that is y = 3.914.
  Footprint diamond{.yaw_rad = 45 * kDeg, .half_m = Vec2(1, 1)};
  diamond.middle_W_m = Vec2(1, 3.9);
  EXPECT_TRUE(Meet(lying, diamond, 0));
  diamond.middle_W_m = Vec2(1, 3.93);
  EXPECT_FALSE(Meet(lying, diamond, 0));
}

TEST(Footprint, CornersAreTurnedAboutTheMiddle) {
  const Footprint f{.middle_W_m = Vec2(5, 1), .yaw_rad = 90 * kDeg, .half_m = Vec2(2, 1)};
  EXPECT_LT((f.Corners_W_m()[0] - Vec2(4, 3)).norm(), 1e-12);
  EXPECT_LT((f.Corners_W_m()[2] - Vec2(6, -1)).norm(), 1e-12);
}

}  // namespace
}  // namespace tera
