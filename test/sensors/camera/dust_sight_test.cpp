#include "sensors/camera/dust_sight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/air/dust_box.h"

namespace tera {
namespace {

using testing::DustBox;

CameraIntrinsics Lens() {
  CameraIntrinsics lens;
  lens.width_px = 40;
  lens.height_px = 30;
  lens.fx_px = lens.fy_px = 30;
  lens.cx_px = 19.5;
  lens.cy_px = 14.5;
  return lens;
}

/// Looking along +y of W from (1, -3, 2).
SeenScene Scene(const DustVolume* dust) {
  SeenScene scene;
  Mat3 R;
  R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  scene.X_WC = MakePose(Vec3(1, -3, 2), R);
  scene.state.dust = dust;
  return scene;
}

TEST(DustSight, OpticalDepthIsExtinctionTimesTheWayOfEachPixel) {
  // Dust from y = 0 to 5 m, wide enough for all pixels. A wall at a depth of 6 m is behind 3 m of
  // dust, at y = 3; the sky is behind all 5 m.
  const DustVolume dust = DustBox(Vec3(-15, 0, -10), 0.5, {64, 10, 48}, 0.3);
  Image<float> depth_m(40, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 20; ++x) depth_m.at(x, y) = 6;
  }
  const Image<float> tau = DustOpticalDepths(PixelRays(Lens()), Scene(&dust), depth_m);
  const auto slant = [](int x, int y) { return std::hypot(1.0, (x - 19.5) / 30, (y - 14.5) / 30); };
  EXPECT_NEAR(tau.at(3, 20), 0.3 * 3 * slant(3, 20), 0.02);
  EXPECT_NEAR(tau.at(19, 14), 0.3 * 3, 0.02);
  EXPECT_NEAR(tau.at(35, 8), 0.3 * 5 * slant(35, 8), 0.02);
  EXPECT_EQ(DustLabel(tau).at(19, 14), std::lround(1000 * tau.at(19, 14)));
}

TEST(DustSight, NoDustIsNoOpticalDepth) {
  const Image<float> tau =
      DustOpticalDepths(PixelRays(Lens()), Scene(nullptr), Image<float>(40, 30));
  for (const float t : tau.data) EXPECT_EQ(t, 0);
  EXPECT_EQ(PixelOfOpticalDepth(0), 0);
  EXPECT_EQ(PixelOfOpticalDepth(1.2344), 1234);
  EXPECT_EQ(PixelOfOpticalDepth(80), 65535);
}

TEST(DustSight, DepthIsLostWhereFivePercentOfTheContrastIsLeft) {
  Image<float> tau(2, 1), depth_m(2, 1);
  depth_m.data = {7, 7};
  tau.data = {2.9f, 3.1f};  // -ln 0.05 is 2.996
  LoseDepthInAir(tau, &depth_m);
  EXPECT_EQ(depth_m.data[0], 7);
  EXPECT_EQ(depth_m.data[1], 0);
}

TEST(DustSight, FogAddsItsExtinctionTimesTheWayToEachSurface) {
  Image<float> depth_m(40, 30), dust(40, 30);
  depth_m.at(3, 20) = 6;
  dust.at(3, 20) = 0.25f;
  const Image<float> tau = AirOpticalDepths(PixelRays(Lens()), 0.1, dust, depth_m);
  EXPECT_NEAR(tau.at(3, 20), 0.25 + 0.6 * std::hypot(1.0, -16.5 / 30, 5.5 / 30), 1e-5);
  EXPECT_EQ(tau.at(4, 20), 0) << "the sky";
  EXPECT_NEAR(AirOpticalDepths(PixelRays(Lens()), 0.1, {}, depth_m).at(3, 20), tau.at(3, 20) - 0.25,
              1e-6);
}

}  // namespace
}  // namespace tera
