#include "dataset/lint/checks/lens_projection.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

CameraLens Lens() {
  CameraLens lens;
  lens.width_px = 640;
  lens.height_px = 480;
  lens.fx_px = 400;
  lens.fy_px = 410;
  lens.cx_px = 320;
  lens.cy_px = 240;
  return lens;
}

// By hand for (0.3, -0.2, 1): r2 = 0.13, radial 1 - 0.1 * 0.13 + 0.02 * 0.0169 = 0.987338, x
// 0.2962014 + 2 * 1e-3 * (-0.06) + 2e-3 * (0.13 + 0.18).
TEST(LensProjection, FollowsBrownAndConrady) {
  CameraLens lens = Lens();
  lens.k1 = -0.1;
  lens.k2 = 0.02;
  lens.p1 = 1e-3;
  lens.p2 = 2e-3;
  const auto px = Project(Vec3(0.6, -0.4, 2), lens);
  ASSERT_TRUE(px);
  EXPECT_NEAR(px->x(), 320 + 400 * (0.2962014 - 0.00012 + 0.00062), 1e-4);
  EXPECT_NEAR(px->y(), 240 + 410 * (-0.1974676 + 0.00021 - 0.00024), 1e-4);
  const auto ray = RayOf(*px, lens);
  ASSERT_TRUE(ray);
  EXPECT_TRUE(ray->isApprox(Vec3(0.3, -0.2, 1).normalized(), 1e-6)) << ray->transpose();
}

TEST(LensProjection, HasNothingBehindTheCameraOrFarFromItsAxis) {
  EXPECT_FALSE(Project(Vec3(0, 0, -1), Lens()));
  EXPECT_FALSE(Project(Vec3(2, 0, 1), Lens()));
  EXPECT_FALSE(RayOf(Vec2(320 + 400 * 2, 240), Lens()));
}

TEST(LensProjection, OpticalAndSensorFrameAreThoseOfTheFormat) {
  EXPECT_EQ(OpticalOf(Vec3(1, 2, 3)), Vec3(-2, -3, 1));
  EXPECT_EQ(SensorOf(Vec3(-2, -3, 1)), Vec3(1, 2, 3));
}

}  // namespace
}  // namespace tera
