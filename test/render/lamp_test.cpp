#include "render/lamp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "gl/rasterizer_stage.h"
#include "render/gl/rasterizer.h"

/// Lamps and clouds, against photometry.

namespace tera {
namespace {

/// A wall across y of W, 4 m ahead of the eye, white except for a tenth, on a night without a sky.
Stage NightBeforeAWall() {
  Stage stage;
  stage.AddBox(MakePose(Vec3(0, 4.1, 1)), {6, 0.1, 5}, SemanticClass::kStructure,
               Vec3::Constant(0.9));
  stage.model.environment.sun_illuminance_klx = 0;
  stage.model.environment.sky_illuminance_lx = 1e-6;
  stage.model.environment.fog_visibility_m = 1e6;
  return stage;
}

/// At `eye`, its beam along +y of W.
Lamp LampAt(const Vec3& eye_W_m) {
  return {.X_BL = MakePose(eye_W_m, 0, 0, 90 * kDeg), .flux_lm = 3000, .half_angle_rad = 30 * kDeg};
}

double Luminance(const LuminancePicture& picture, int x, int y) {
  return picture.cdpm2.at(x, y, 1);
}

LuminancePicture Shoot(const Stage& stage) {
  LuminancePicture picture{.white_cdpm2 = 300};
  Rasterizer(stage.model, EglOptions{})
      .RenderLuminance(Pinhole(), LookAt({0, 0, 1}, {0, 1, 1}), stage.state, &picture);
  return picture;
}

TEST(Lamp, BeamHoldsItsFlux) {
  // Within a small cone sin a is a: flux = 2 pi I0 h^2 / 6.
  Lamp narrow{.flux_lm = 100, .half_angle_rad = 1 * kDeg};
  EXPECT_NEAR(PeakIntensity_cd(narrow) * kPi * std::pow(1 * kDeg, 2) / 3, 100, 0.02);
}

TEST(Lamp, WideBeamHoldsItsFluxToo) {
  // The integral of (1 - (a/h)^2)^2 sin a from 0 to h, by Simpson's rule.
  const double h = 75 * kDeg;
  constexpr int kHalves = 50;
  double sum = 0;
  for (int i = 0; i <= 2 * kHalves; ++i) {
    const double a = h * i / (2 * kHalves);
    const double weight = i == 0 || i == 2 * kHalves ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * std::pow(1 - a * a / (h * h), 2) * std::sin(a);
  }
  const double solid_sr = 2 * kPi * sum * h / (6 * kHalves);
  EXPECT_NEAR(PeakIntensity_cd({.flux_lm = 500, .half_angle_rad = h}) * solid_sr, 500, 0.01);
}

TEST(Lamp, MovesWithItsBody) {
  Stage stage = NightBeforeAWall();
  // The lamp sits 0.5 m above the origin of a box that is out of sight, and looks along its x.
  const Vec3 half_m(0.05, 0.05, 0.05);
  stage.AddBox(MakePose(Vec3(0.6, 1, 0.5), 0, 0, 90 * kDeg), half_m, SemanticClass::kRock);
  Lamp lamp = LampAt(Vec3::Zero());
  lamp.body = 1;
  lamp.X_BL = MakePose(Vec3(0, 0, 0.5));
  stage.model.lamps = {lamp};
  const LuminancePicture picture = Shoot(stage);
  const CameraIntrinsics lens = Pinhole();
  const auto at = [&](double x_m) {
    const Vec2 pixel = lens.Project({x_m, 0, 4});
    return Luminance(picture, static_cast<int>(pixel.x() + 0.5), 118);
  };
  EXPECT_GT(at(0.6), 1.02 * at(0.3)) << "brightest where it points";
  EXPECT_GT(at(0.6), 1.02 * at(0.9));
  EXPECT_NEAR(at(0.3), at(0.9), 0.03 * at(0.6));
}

TEST(Lamp, LightsAWallByTheSquareOfItsDistance) {
  Stage stage = NightBeforeAWall();
  const Vec3 lamp_W_m(0, 1, 1);  // 3 m before the wall
  stage.model.lamps = {LampAt(lamp_W_m)};
  const LuminancePicture picture = Shoot(stage);
  const double peak_cd = PeakIntensity_cd(stage.model.lamps[0]);
  const CameraIntrinsics lens = Pinhole();
  // A rough wall reflects 0.9 E / pi plus its sheen, a few hundredths.
  for (const double x_m : {0.0, 0.5, 0.9}) {
    const double off = std::atan(x_m / 3), d2 = 9 + x_m * x_m;
    const double pattern = std::pow(1 - std::pow(off / (30 * kDeg), 2), 2);
    const double expected = 0.9 / kPi * peak_cd * pattern / d2 * std::cos(off);
    const Vec2 at = lens.Project({x_m, 0, 4});
    const double seen =
        Luminance(picture, static_cast<int>(at.x() + 0.5), static_cast<int>(at.y() + 0.5));
    EXPECT_NEAR(seen, expected, 0.12 * expected) << x_m;
    EXPECT_GE(seen, 0.95 * expected) << x_m;
  }
  // The beam ends 1.73 m from its middle.
  const Vec2 beyond = lens.Project({1.9, 0, 4});
  EXPECT_LT(Luminance(picture, static_cast<int>(beyond.x()), static_cast<int>(beyond.y())), 1e-3);
}

TEST(Lamp, ThrowsAShadow) {
  Stage stage = NightBeforeAWall();
  stage.model.lamps = {LampAt({0, 1, 1})};
  const LuminancePicture open = Shoot(stage);
  // A board 0.2 m wide, 1.5 m before the lamp: its shadow on the wall is 0.4 m wide. It hangs above
  // the line of sight to the shadow's upper part.
  stage.AddBox(MakePose(Vec3(0, 2.5, 1.3)), {0.1, 0.01, 0.1}, SemanticClass::kBarrier);
  const LuminancePicture shaded = Shoot(stage);
  const CameraIntrinsics lens = Pinhole();
  const auto ratio = [&](double x_m, double z_m) {
    const Vec2 at = lens.Project({x_m, 1 - z_m, 4});
    const int x = static_cast<int>(at.x() + 0.5), y = static_cast<int>(at.y() + 0.5);
    return Luminance(shaded, x, y) / Luminance(open, x, y);
  };
  // The shadow reaches from 0.4 to 0.8 m above the lamp. The eye, a metre behind the lamp, sees the
  // board from 0.32 to 0.64 m there.
  EXPECT_LT(ratio(0, 1.72), 0.02);
  EXPECT_LT(ratio(0.15, 1.72), 0.02);
  EXPECT_GT(ratio(0.3, 1.72), 0.95);
  EXPECT_GT(ratio(0, 1.9), 0.95);
}

/// Luminance of level white ground under a sky, which is E / pi of its albedo.
double LuminanceOfGround(std::optional<double> cover, const Environment& environment) {
  Stage stage;
  stage.AddBox(MakePose(Vec3(0, 0, -0.1)), {30, 30, 0.1}, SemanticClass::kStructure,
               Vec3::Constant(0.5));
  stage.model.environment = environment;
  stage.model.environment.cloud_cover = cover;
  stage.model.environment.fog_visibility_m = 1e6;
  LuminancePicture picture{.white_cdpm2 = 1e5};
  Rasterizer(stage.model, EglOptions{})
      .RenderLuminance(Pinhole(), LookAt({0, 0, 4}, {0.5, 2, 0}), stage.state, &picture);
  return Luminance(picture, 160, 120);
}

TEST(Clouds, LeaveWhatKastenAndCzeplakMeasured) {
  Environment environment;
  environment.to_sun_W = Vec3(0.3, 0.4, 0.8).normalized();
  environment.sun_illuminance_klx = 80;
  const double clear = LuminanceOfGround(0.0, environment);
  for (const double cover : {0.3, 0.7, 1.0}) {
    const double left = 1 - 0.75 * std::pow(cover, 3.4);
    // Nine coefficients hold a sky to some hundredths.
    EXPECT_NEAR(LuminanceOfGround(cover, environment) / clear, left, 0.05) << cover;
  }
}

TEST(Clouds, OvercastSkyHasNoSun) {
  Stage stage;
  stage.model.environment.cloud_cover = 1;
  LuminancePicture picture{.white_cdpm2 = 1e4};
  const Vec3 to_sun_W = stage.model.environment.to_sun_W;
  Rasterizer(stage.model, EglOptions{})
      .RenderLuminance(Pinhole(), LookAt({0, 0, 1}, Vec3(0, 0, 1) + to_sun_W), stage.state,
                       &picture);
  double lowest = 1e9, highest = 0;
  for (int x = 0; x < 320; x += 4) {
    lowest = std::min(lowest, Luminance(picture, x, 117));
    highest = std::max(highest, Luminance(picture, x, 117));
  }
  EXPECT_LT(highest, 1.8 * lowest);
}

TEST(Twilight, SkyGivesTheIlluminanceAskedFor) {
  Environment environment;
  environment.to_sun_W = Vec3(1, 0, -0.1).normalized();
  environment.sun_illuminance_klx = 0;
  environment.sky_illuminance_lx = 3.4;
  EXPECT_NEAR(LuminanceOfGround(std::nullopt, environment), 0.5 * 3.4 / kPi, 0.12 * 0.5);
}

}  // namespace
}  // namespace tera
