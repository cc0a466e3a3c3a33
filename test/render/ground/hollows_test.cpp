#include "render/ground/hollows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

TEST(Hollows, WaterStandsToTheBrimOrToItsDepth) {
  // A row of ground, three cells wide: 5 4 2 4 3 1 0.5 3.5 6, with 9 on both sides of the middle
  // row, so that water leaves over its ends only. The left end fills everything to 5.
  constexpr int kWidth = 9;
  const float middle[kWidth] = {5, 4, 2, 4, 3, 1, 0.5f, 3.5f, 6};
  std::vector<float> height(3 * kWidth, 9.0f);
  for (int i = 0; i < kWidth; ++i) height[kWidth + i] = middle[i];
  const std::vector<float> full = WaterLevels(height, kWidth, 3, 100);
  EXPECT_EQ(full[kWidth], kDry);
  for (int i = 1; i < 8; ++i) EXPECT_EQ(full[kWidth + i], 5) << i;
  const std::vector<float> shallow = WaterLevels(height, kWidth, 3, 0.75);
  for (int i = 1; i < 8; ++i) EXPECT_NEAR(shallow[kWidth + i], 1.25, 1e-6) << i;
  for (int i = 0; i < kWidth; ++i) EXPECT_EQ(full[i], kDry);
}

TEST(Hollows, ASlopeIsDryAndABowlHoldsACap) {
  constexpr int kSide = 81;
  std::vector<float> slope, bowl;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double x = 0.05 * (i - 40), y = 0.05 * (j - 40);
      slope.push_back(static_cast<float>(0.1 * x + 0.02 * y));
      bowl.push_back(static_cast<float>(std::min(0.25 * (x * x + y * y), 0.5)));
    }
  }
  for (const float level : WaterLevels(slope, kSide, kSide, 1)) ASSERT_EQ(level, kDry);
  // A paraboloid z = r^2 / 4 under 0.2 m of water: an area of pi 4 0.2 m^2.
  const std::vector<float> level = WaterLevels(bowl, kSide, kSide, 0.2);
  double wet_m2 = 0;
  for (std::size_t k = 0; k < level.size(); ++k) wet_m2 += level[k] > bowl[k] ? 0.05 * 0.05 : 0;
  EXPECT_NEAR(wet_m2, M_PI * 4 * 0.2, 0.05);
}

}  // namespace
}  // namespace tera
