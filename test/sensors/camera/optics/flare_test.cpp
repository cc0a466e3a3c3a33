#include "sensors/camera/optics/flare.h"

#include <gtest/gtest.h>

#include <numeric>

namespace tera {
namespace {

CameraIntrinsics FlareLens() {
  return {
      .width_px = 641, .height_px = 481, .fx_px = 500, .fy_px = 500, .cx_px = 320, .cy_px = 240};
}

Image<float> GhostsOf(const FlareModel& model, const Vec2& source_px, std::uint64_t seed = 1) {
  Image<float> picture(FlareLens().width_px, FlareLens().height_px, 3);
  Flare(model, FlareLens(), Stream(seed, "m/camera/flare"))
      .Apply(source_px, Vec3(1e5, 1e5, 1e5), &picture);
  return picture;
}

/// Mean place of the light of all colours, and its sum in lx: luminance times solid angle.
struct Light {
  Vec2 middle_px = Vec2::Zero();
  double sum_lx = 0;
};

Light LightOf(const Image<float>& picture) {
  Light light;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const double here =
          double(picture.at(x, y, 0) + picture.at(x, y, 1) + picture.at(x, y, 2)) / 3;
      light.sum_lx += here / (500.0 * 500.0);
      light.middle_px += here / (500.0 * 500.0) * Vec2(x, y);
    }
  }
  light.middle_px /= light.sum_lx;
  return light;
}

// Two reflections of 2 % each: a ghost has 1 / 2500 of the source's 100 000 lx. A source on the
// axis has all its ghosts there, within the picture.
TEST(Flare, AGhostHasTheSquareOfTheReflectanceOfTheLight) {
  const Light light = LightOf(GhostsOf({.ghosts = 5, .reflectance = 0.02}, Vec2(320, 240)));
  EXPECT_NEAR(light.sum_lx, 5 * 0.02 * 0.02 * 1e5, 0.02 * 200);
  EXPECT_NEAR(light.middle_px.x(), 320, 0.1);
  EXPECT_NEAR(light.middle_px.y(), 240, 0.1);
}

// One ghost: its place is linear in the source's about the principal point.
TEST(Flare, AGhostLiesOnTheLineThroughTheMiddle) {
  const FlareModel one{.ghosts = 1, .reflectance = 0.02};
  const Vec2 centre_px(320, 240), source_px(350, 225);
  const Vec2 once = LightOf(GhostsOf(one, source_px)).middle_px - centre_px;
  const Vec2 twice = LightOf(GhostsOf(one, centre_px + 2 * (source_px - centre_px))).middle_px;
  EXPECT_NEAR((twice - centre_px - 2 * once).norm(), 0, 0.1);
  const Vec2 to_source_px = source_px - centre_px;
  EXPECT_NEAR(once.x() * to_source_px.y() - once.y() * to_source_px.x(), 0, 1);
  EXPECT_GT(once.norm(), 1);
}

TEST(Flare, TheSeedDrawsTheLens) {
  const Vec2 source_px(350, 225);
  EXPECT_EQ(GhostsOf({}, source_px).data, GhostsOf({}, source_px).data);
  EXPECT_NE(GhostsOf({}, source_px).data, GhostsOf({}, source_px, 2).data);
}

}  // namespace
}  // namespace tera
