#include "survey/points/raster_steps.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(RasterSteps, PixelsOnBothSidesOfAWallAreLeftOutAndSlopesStay) {
  // Columns 0 to 9 of a slope of 40 degrees, from column 6 on 1 m higher.
  std::vector<Vec3> pixels;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 10; ++i) {
      pixels.emplace_back(1000 + 0.2 * i, 50 + 0.2 * j, 0.84 * 0.2 * j + (i >= 6 ? 1.0 : 0.0));
    }
  }
  const std::vector<Vec3> kept = WithoutSteps(pixels, Vec2(0.2, 0.2));
  EXPECT_EQ(kept.size(), 4u * 8u);
  for (const Vec3& p : kept) {
    EXPECT_GT(std::abs(p.x() - 1001.1), 0.25) << p.transpose();  // columns 5 and 6
  }
}

}  // namespace
}  // namespace tera
