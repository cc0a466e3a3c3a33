#include "sensors/camera/object_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

using testing::OneBodyEach;
using testing::WallMesh;

constexpr double kFocal_px = 150, kDistance_m = 6, kExposure_s = 0.05;
constexpr TimeNs kStamp_ns = 400'000'000;

/// A matt square, 2 m wide, 6 m ahead of a camera that looks along +y of W, and a large square 60 m
/// to the side, outside the picture. The sun stands behind the camera and to its right, 30 degrees
/// high.
class SquareInTheSun : public ::testing::Test {
 protected:
  SquareInTheSun() : model_(OneBodyEach({Matt(1), Matt(8)})) {
    model_.environment.to_sun_W = kToSun_W.normalized();
    camera_.intrinsics = {.width_px = 160,
                          .height_px = 120,
                          .fx_px = kFocal_px,
                          .fy_px = kFocal_px,
                          .cx_px = 79.5,
                          .cy_px = 59.5};
    camera_.image_sensor.emplace();
    camera_.image_sensor->exposure_s = kExposure_s;
    camera_.image_sensor->shutter.emplace();
    camera_.object_labels.exposure = true;
  }

  static Mesh Matt(double half_m) {
    Mesh mesh = WallMesh(half_m, 0.5);
    mesh.parts[0].material.albedo = Vec3(0.4, 0.4, 0.4);
    mesh.parts[0].material.roughness = 1;
    return mesh;
  }

  /// The square moves at `square_W_mps`; the other stands at `other_W_m`, turned to the sun.
  CameraFrame Shoot(const Vec3& square_W_mps, const Vec3& other_W_m) {
    Rasterizer rasterizer(model_, {});
    const double turn_rad = std::atan2(kToSun_W.y(), kToSun_W.x());
    sun_lx_ = rasterizer.sun_illuminance_lx();
    return Camera(camera_, {.rate_hz = 5}, 0, 1, "m/camera")
        .Measure(
            2,
            [&](TimeNs t_ns) {
              const Vec3 at_W_m = kSquare_W_m + ToSeconds(t_ns - kStamp_ns) * square_W_mps;
              SeenScene seen;
              seen.X_WC = MakePose({0, 2, 40}, 0, 0, 90 * kDeg) * OpticalInSensor();
              seen.state.t_ns = t_ns;
              seen.state.X_WB = {MakePose(at_W_m, 0, 0, 90 * kDeg),
                                 MakePose(other_W_m, 0, 0, turn_rad)};
              return seen;
            },
            &rasterizer);
  }

  static const ObjectLight& LightOf(const CameraFrame& frame) { return *frame.boxes.at(0).light; }

  static inline const Vec3 kToSun_W{0.5, -0.70710678, 0.5}, kSquare_W_m{0, 2 + kDistance_m, 40};
  static inline const Vec3 kAside_W_m{-60, 10, 40}, kBeforeSun_W_m = kSquare_W_m + 25 * kToSun_W;
  SceneModel model_;
  CameraModel camera_;
  Vec3 sun_lx_ = Vec3::Zero();
};

// Across the picture blur is speed x exposure x f / z: 4 m/s are 100 px/s, 5 px in 50 ms.
TEST_F(SquareInTheSun, BlurIsItsSpeedTimesTheExposureInThePicture) {
  const CameraFrame frame = Shoot({4, 0, 0}, kAside_W_m);
  ASSERT_EQ(frame.boxes.size(), 1u);
  EXPECT_NEAR(LightOf(frame).blur_px, 4 * kExposure_s * kFocal_px / kDistance_m, 1e-3);
  EXPECT_NEAR(LightOf(frame).most_blur_px, 5, 1e-3);
  EXPECT_NEAR(LightOf(Shoot({3, 0, 4}, kAside_W_m)).blur_px, 5 * 1.25, 1e-3);
}

// An approaching object expands: a point at the radius r moves by r v t / z, corners most.
TEST_F(SquareInTheSun, WhatComesNearerIsBlurredTowardsItsRim) {
  const CameraFrame frame = Shoot({0, -12, 0}, kAside_W_m);
  const double most_px = std::sqrt(2.0) * 25 * 12 * kExposure_s / kDistance_m;
  EXPECT_NEAR(LightOf(frame).most_blur_px, most_px, 0.05 * most_px);
  // The mean distance from the middle of a square of half side a is 0.7652 a.
  EXPECT_NEAR(LightOf(frame).blur_px, 0.7652 * 25 * 0.1, 0.03 * 1.9);
}

TEST_F(SquareInTheSun, WithoutAShutterNothingIsBlurred) {
  camera_.image_sensor->shutter.reset();
  EXPECT_EQ(LightOf(Shoot({4, 0, 0}, kAside_W_m)).blur_px, 0);
}

// The sun's illuminance on a plane is that of a facing plane times the cosine, here of 45 degrees.
// The large square in front of the sun removes exactly that.
TEST_F(SquareInTheSun, ShadowTakesTheSunAway) {
  const CameraFrame sunlit = Shoot({0, 0, 0}, kAside_W_m),
                    shaded = Shoot({0, 0, 0}, kBeforeSun_W_m);
  EXPECT_NEAR(LightOf(sunlit).shadow, 0, 1e-6);
  EXPECT_NEAR(LightOf(shaded).shadow, 1, 1e-6);
  const double sun_lx = sun_lx_.dot(Vec3(0.2126, 0.7152, 0.0722));
  EXPECT_GT(sun_lx, 5e4);
  EXPECT_NEAR(LightOf(sunlit).illuminance_lx - LightOf(shaded).illuminance_lx, 0.70710678 * sun_lx,
              0.01 * sun_lx);
  EXPECT_GT(LightOf(shaded).illuminance_lx, 1000) << "the sky is left";
}

// A matt surface of the albedo a has the luminance a E / pi; sheen adds a few hundredths of E / pi.
TEST_F(SquareInTheSun, LuminanceIsWhatAMattSurfaceGivesBack) {
  const ObjectLight light = LightOf(Shoot({0, 0, 0}, kAside_W_m));
  const double matt_cdpm2 = 0.4 * light.illuminance_lx / kPi;
  EXPECT_GT(light.luminance_cdpm2, 0.97 * matt_cdpm2);
  EXPECT_LT(light.luminance_cdpm2, 1.15 * matt_cdpm2);
}

TEST_F(SquareInTheSun, HalfInTheShadeIsHalf) {
  // A wall whose edge, seen from the sun, cuts the square upright in its middle.
  const Vec3 beside_W(std::sqrt(0.5) * 1.41421356, 0.5 * 1.41421356, 0);
  const Vec3 along_W = Vec3(kToSun_W.y(), -kToSun_W.x(), 0).normalized();
  (void)beside_W;
  const CameraFrame frame = Shoot({0, 0, 0}, kBeforeSun_W_m + 8 * along_W);
  EXPECT_NEAR(LightOf(frame).shadow, 0.5, 0.06);
}

TEST_F(SquareInTheSun, AFisheyeSaysTheSame) {
  const ObjectLight pinhole = LightOf(Shoot({4, 0, 0}, kAside_W_m));
  camera_.intrinsics.kind = LensKind::kKannalaBrandt;
  camera_.intrinsics.field_rad = 3;
  const ObjectLight fisheye = LightOf(Shoot({4, 0, 0}, kAside_W_m));
  EXPECT_NEAR(fisheye.illuminance_lx, pinhole.illuminance_lx, 0.01 * pinhole.illuminance_lx);
  EXPECT_NEAR(fisheye.blur_px, pinhole.blur_px, 0.02 * pinhole.blur_px);  // theta for its tangent
}

TEST_F(SquareInTheSun, ThePicturesExposureStandsBeside) {
  const CameraFrame frame = Shoot({0, 0, 0}, kAside_W_m);
  ASSERT_TRUE(frame.exposure);
  EXPECT_EQ(frame.exposure->exposure_s, kExposure_s);
  EXPECT_EQ(frame.exposure->f_number, 4);
  // Electrons over the full well for one candela per square metre: image_sensor.h's equations.
  const ImageSensorModel& s = *camera_.image_sensor;
  const double lux_s = kPi * s.transmission / (4 * 4 * 4) * kExposure_s;
  const double photons = lux_s * kPhotonsPerLuxSecond / 3 * std::pow(s.pixel_um * 1e-6, 2);
  EXPECT_NEAR(frame.exposure->saturation_cdpm2, s.full_well_e / (s.quantum_efficiency[1] * photons),
              1e-6);
}

}  // namespace
}  // namespace tera
