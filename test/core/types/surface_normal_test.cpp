#include "core/types/surface_normal.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tera {
namespace {

TEST(SurfaceNormal, ComesBackToWithinHalfAStep) {
  for (const Vec3& n : {Vec3(2, -3, 6), Vec3(-1, 0, 0), Vec3(0.01, 0.02, -5), Vec3(-1, -1, -1)}) {
    Image<std::uint16_t> image(2, 3, 3);
    const auto pixel = PixelOfNormal(n.normalized());
    std::copy(pixel.begin(), pixel.end(), &image.at(1, 2));
    const auto back = NormalAt(image, 1, 2);
    ASSERT_TRUE(back);
    // Half a step, 1 / 65534, in each of three components, and once more for the length.
    EXPECT_LT((*back - n.normalized()).norm(), 4e-5);
    EXPECT_NEAR(back->norm(), 1, 1e-12);
    EXPECT_FALSE(NormalAt(image, 0, 2));
  }
}

TEST(SurfaceNormal, OfAnAxisIsTheWholeScale) {
  EXPECT_EQ(PixelOfNormal(Vec3(0, -1, 0)), (std::array<std::uint16_t, 3>{32767, 0, 32767}));
  EXPECT_EQ(PixelOfNormal(Vec3(0, 0, 1)), (std::array<std::uint16_t, 3>{32767, 32767, 65534}));
}

}  // namespace
}  // namespace tera
