#include "render/ground/ground_cover.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

TEST(GroundCover, SnowLiesOnWhatIsFlatEnoughAndHasNotBeenWorked) {
  Weather winter;
  winter.snow_depth_m = 0.2;
  EXPECT_NEAR(SnowShare(winter, {}, 1), 1, 1e-3);
  EXPECT_NEAR(SnowShare(winter, {}, std::cos(30 * kDeg)), 1, 1e-3);
  EXPECT_EQ(SnowShare(winter, {}, std::cos(55 * kDeg)), 0);
  EXPECT_EQ(SnowShare(winter, {.looseness = 255}, 1), 0);
  EXPECT_EQ(SnowShare(winter, {.rut = 255}, 1), 0);
  winter.snow_depth_m = 0.025;  // tanh 1
  EXPECT_NEAR(SnowShare(winter, {}, 1), 0.7616, 1e-4);
  EXPECT_EQ(SnowShare({}, {}, 1), 0);
}

}  // namespace
}  // namespace tera
