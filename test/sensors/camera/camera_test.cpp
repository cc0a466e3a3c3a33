#include "sensors/camera/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types/surface_normal.h"
#include "core/units.h"
#include "render/hand_made_scene.h"
#include "render/rays/ray_scene.h"
#include "sensors/sensor.h"

namespace tera {
namespace {

using testing::Ground;
using testing::OneBodyEach;
using testing::WallMesh;

/// A wall 6 m ahead of a camera that stands at (1, 2, 1.5) and looks along +y of W.
class CameraBeforeAWall : public ::testing::Test {
 protected:
  CameraBeforeAWall()
      : model_(OneBodyEach({WallMesh(3, 0.5)})),
        ground_(Ground(101, 101, 0.2, -10, [](double, double) { return 0.0; })),
        rasterizer_(model_, {}) {
    scene_.X_WB = {MakePose({1, 8, 1.5}, 0, 0, 90 * kDeg)};
    scene_.terrain = &ground_;
    camera_.intrinsics = {.width_px = 160,
                          .height_px = 120,
                          .fx_px = 150,
                          .fy_px = 150,
                          .cx_px = 79.5,
                          .cy_px = 59.5};
    camera_.depth = true;
  }

  CameraFrame Measure(const CameraModel& model, std::int64_t k = 2) {
    return Camera(model, {.rate_hz = 10}, 3'000'000, 1, "m/camera")
        .Measure(k, MakePose({1, 2, 1.5}, 0, 0, 90 * kDeg), scene_, &rasterizer_);
  }

  SceneModel model_;
  TerrainSurface ground_;
  Rasterizer rasterizer_;
  SceneState scene_;
  CameraModel camera_;
};

TEST(OpticalInSensor, ZIsForwardXRightYDown) {
  const Mat3 R_SC = OpticalInSensor().linear();
  EXPECT_EQ(R_SC * Vec3::UnitZ(), Vec3::UnitX());
  EXPECT_EQ(R_SC * Vec3::UnitX(), Vec3(0, -1, 0));
  EXPECT_EQ(R_SC * Vec3::UnitY(), Vec3(0, 0, -1));
}

TEST_F(CameraBeforeAWall, SeesTheWallAtItsPlanarDepth) {
  const CameraFrame frame = Measure(camera_);
  EXPECT_EQ(frame.t_ns, 200'000'000);
  EXPECT_EQ(frame.t_available_ns, 203'000'000);
  EXPECT_EQ(frame.rgb.channels, 3);
  EXPECT_NEAR(frame.depth_m.at(80, 60), 6, 1e-3);
  EXPECT_NEAR(frame.depth_m.at(30, 50), 6, 1e-3);
  EXPECT_EQ(frame.instance.at(80, 60), 1);
  EXPECT_EQ(frame.semantic.at(80, 60), static_cast<std::uint8_t>(SemanticClass::kStructure));
}

TEST_F(CameraBeforeAWall, DepthAgreesWithRaysThroughThePixels) {
  // On ground and wall, away from edges, where a pixel's centre may fall on either side.
  RayScene rays(model_);
  rays.Update({scene_.X_WB}, ground_);
  camera_.depth_max_m = 7.5;  // within the border of the site
  const CameraFrame frame = Measure(camera_);
  const Pose X_WC = MakePose({1, 2, 1.5}, 0, 0, 90 * kDeg) * OpticalInSensor();
  int compared = 0;
  for (int y = 2; y < 118; y += 3) {
    for (int x = 2; x < 158; x += 3) {
      if (frame.depth_m.at(x, y) == 0 ||
          frame.semantic.at(x, y - 2) != frame.semantic.at(x, y + 2) ||
          frame.semantic.at(x - 2, y) != frame.semantic.at(x + 2, y)) {
        continue;
      }
      const Vec3 d_C = camera_.intrinsics.Unproject(Vec2(x, y)).normalized();
      const Ray ray = {.origin_W_m = X_WC.translation().cast<float>(),
                       .direction_W = (X_WC.linear() * d_C).cast<float>()};
      RayHit hit;
      rays.Trace({&ray, 1}, {&hit, 1}, 1);
      ASSERT_TRUE(hit.hit) << x << " " << y;
      EXPECT_NEAR(frame.depth_m.at(x, y), hit.range_m * d_C.z(), 1e-3) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 500);
}

TEST_F(CameraBeforeAWall, EveryKeyChangesThePicture) {
  const auto measure = [&](const std::string& keys) {
    const Config config =
        Config::FromText("sensor: {name: s, type: camera, link: b, " + keys + "}", "rig.yaml");
    const SensorDescription s = ReadSensor(config.root().Map("sensor"));
    config.Finish();
    return Camera(std::get<CameraModel>(s.model), s.clock, s.latency_ns, 1, "m/s")
        .Measure(1, MakePose({1, 2, 1.5}, 0, 0, 90 * kDeg), scene_, &rasterizer_);
  };
  const auto alike = [](const CameraFrame& a, const CameraFrame& b) {
    return a.rgb.data == b.rgb.data && a.depth_m.data == b.depth_m.data &&
           a.semantic.data == b.semantic.data && a.instance.data == b.instance.data &&
           a.normal.data == b.normal.data;
  };
  const std::string size = "rate_hz: 10, width_px: 80, height_px: 60, depth: true";
  const CameraFrame plain = measure(size + ", fx_px: 75");
  ASSERT_TRUE(alike(plain, measure(size + ", fx_px: 75")));
  for (const std::string change :
       {"fy_px: 70", "cx_px: 30", "cy_px: 20", "k1: 0.05", "k2: 0.05", "p1: 0.02", "p2: 0.02",
        "k3: 0.05", "near_m: 6.5", "far_m: 7", "rgb: false", "labels: false",
        "labels: [semantic, instance, normal]", "depth_min_m: 6.5", "depth_max_m: 5.5",
        "disparity_noise_px: 0.1", "rgb_noise: 2"}) {
    EXPECT_FALSE(alike(plain, measure(size + ", fx_px: 75, " + change))) << change;
  }
  EXPECT_FALSE(alike(plain, measure(size + ", fx_px: 80")));
  EXPECT_FALSE(alike(plain, measure(size + ", horizontal_fov_deg: 60")));
  const std::string noise = size + ", fx_px: 75, disparity_noise_px: 0.1";
  EXPECT_FALSE(alike(measure(noise), measure(noise + ", baseline_m: 0.2")));
  EXPECT_TRUE(measure("rate_hz: 10, width_px: 80, height_px: 60, fx_px: 75").depth_m.empty());
  const CameraFrame wide = measure("rate_hz: 20, width_px: 90, height_px: 50, fx_px: 75");
  EXPECT_EQ(wide.rgb.width_px, 90);
  EXPECT_EQ(wide.rgb.height_px, 50);
  EXPECT_EQ(wide.t_ns, 50'000'000);
  EXPECT_EQ(wide.t_available_ns, 50'000'000);
  EXPECT_EQ(measure(size + ", fx_px: 75, latency_s: 0.025").t_available_ns, 125'000'000);
}

TEST_F(CameraBeforeAWall, OutputsThatAreOffAreEmpty) {
  camera_.rgb = false;
  camera_.labels.reset();
  CameraFrame frame = Measure(camera_);
  EXPECT_TRUE(frame.rgb.empty());
  EXPECT_FALSE(frame.depth_m.empty());
  EXPECT_TRUE(frame.semantic.empty());
  EXPECT_TRUE(frame.instance.empty());
  EXPECT_TRUE(frame.boxes.empty());
  camera_.rgb = true;
  camera_.depth = false;
  frame = Measure(camera_);
  EXPECT_FALSE(frame.rgb.empty());
  EXPECT_TRUE(frame.depth_m.empty());
}

TEST_F(CameraBeforeAWall, NormalsAreTakenWhereTheyAreAskedFor) {
  EXPECT_TRUE(Measure(camera_).normal.empty());
  camera_.labels.reset();
  camera_.labels.set(kNormalChannel);
  const CameraFrame frame = Measure(camera_);
  EXPECT_TRUE(frame.semantic.empty());
  EXPECT_TRUE(frame.boxes.empty());
  ASSERT_FALSE(frame.normal.empty());
  // The wall stands across the line of sight: its normal points back along z of C.
  const auto n_C = NormalAt(frame.normal, 80, 60);
  ASSERT_TRUE(n_C);
  EXPECT_LT((*n_C + Vec3::UnitZ()).norm(), 1e-4);
}

TEST_F(CameraBeforeAWall, DepthOutsideItsLimitsIsNotMeasured) {
  camera_.depth_max_m = 5.9;
  EXPECT_EQ(Measure(camera_).depth_m.at(80, 60), 0);
  camera_.depth_max_m = 20;
  camera_.depth_min_m = 6.1;
  EXPECT_EQ(Measure(camera_).depth_m.at(80, 60), 0);
}

TEST_F(CameraBeforeAWall, DepthNoiseGrowsWithTheSquareOfDepth) {
  // sigma_z = 36 * 0.05 / (150 * 0.06) = 0.2 m at 6 m; the second order adds 0.5 %. n > 4000 pixels
  // of wall: five standard errors of the deviation, 5 / sqrt(2 n) = 5.6 %.
  camera_.disparity_noise_px = 0.05;
  camera_.baseline_m = 0.06;
  const CameraFrame frame = Measure(camera_);
  double squares_m2 = 0;
  int n = 0;
  for (std::size_t i = 0; i < frame.depth_m.data.size(); ++i) {
    if (frame.instance.data[i] != 1) continue;
    squares_m2 += std::pow(frame.depth_m.data[i] - 6, 2);
    ++n;
  }
  ASSERT_GT(n, 4000);
  EXPECT_NEAR(std::sqrt(squares_m2 / n), 0.2, 0.061 * 0.2);
}

TEST_F(CameraBeforeAWall, FarDepthIsLostInNoiseAndNeverNear) {
  // A disparity of 150 * 0.06 / 6 = 1.5 px with 0.3 px of noise: within 4.3 sigma none exceeds 2.8
  // px, which is 3.2 m.
  camera_.disparity_noise_px = 0.3;
  camera_.baseline_m = 0.06;
  const CameraFrame frame = Measure(camera_);
  int measured = 0;
  for (std::size_t i = 0; i < frame.depth_m.data.size(); ++i) {
    if (frame.instance.data[i] != 1 || frame.depth_m.data[i] == 0) continue;
    ++measured;
    EXPECT_GT(frame.depth_m.data[i], 3.2) << i;
  }
  EXPECT_GT(measured, 4000);
}

TEST_F(CameraBeforeAWall, RgbNoiseHasItsDeviationAndFollowsTheExposure) {
  // Rounding adds 1/12 to the variance 16. n > 4000 pixels x 3: five standard errors of the
  // deviation are below 3.3 %. Pixels near black or white are excluded, since they are clipped.
  camera_.rgb_noise = 4;
  CameraModel clean = camera_;
  clean.rgb_noise = 0;
  const CameraFrame exact = Measure(clean), noisy = Measure(camera_), next = Measure(camera_, 3);
  double squares = 0;
  int n = 0;
  for (std::size_t i = 0; i < exact.rgb.data.size(); ++i) {
    if (exact.rgb.data[i] < 30 || exact.rgb.data[i] > 225) continue;
    squares += std::pow(double(noisy.rgb.data[i]) - exact.rgb.data[i], 2);
    ++n;
  }
  ASSERT_GT(n, 12000);
  EXPECT_NEAR(std::sqrt(squares / n), std::sqrt(16 + 1.0 / 12), 0.033 * 4);
  EXPECT_NE(noisy.rgb.data, next.rgb.data);
  EXPECT_EQ(noisy.rgb.data, Measure(camera_).rgb.data);
}

/// Mean of the green of a patch of the wall, and half the variance of its difference to another
/// exposure.
struct Patch {
  double mean = 0, variance = 0;
};

Patch PatchOf(const ImageSensor& sensor, const Image<float>& luminance, std::int64_t k) {
  const auto a = sensor.Expose(luminance, k), b = sensor.Expose(luminance, k + 1);
  Patch patch;
  double sum = 0, squares = 0, n = 0;
  for (int y = 40; y < 60; ++y) {
    for (int x = 50; x < 110; ++x, ++n) {
      const double difference = double(a.at(x, y, 1)) - b.at(x, y, 1);
      patch.mean += a.at(x, y, 1);
      sum += difference;
      squares += difference * difference;
    }
  }
  patch.mean /= n;
  patch.variance = 0.5 * (squares / n - std::pow(sum / n, 2));
  return patch;
}

// Photon transfer of a rendered wall over shutter times up to saturation. 1200 pixels determine a
// variance to 4 %, and twenty levels a slope to 1 %. Twenty pairs in the dark determine their
// deviation to half of that.
TEST_F(CameraBeforeAWall, PhotonTransferOfARenderedWallReturnsGainReadNoiseAndFullWell) {
  LuminancePicture seen{.white_cdpm2 = 2e4};
  rasterizer_.RenderLuminance(camera_.intrinsics,
                              MakePose({1, 2, 1.5}, 0, 0, 90 * kDeg) * OpticalInSensor(), scene_,
                              &seen);
  const Image<float>& luminance = seen.cdpm2;
  ImageSensorModel model;
  model.filter.reset();
  model.dark_current_eps = 0;
  model.read_noise_e = 6;
  const auto at = [&](double exposure_s) {
    model.exposure_s = exposure_s;
    return ImageSensor(model, camera_.intrinsics, 1, "m/camera");
  };
  Patch dark;
  for (int k = 0; k < 20; ++k) {
    const Patch pair = PatchOf(at(1e-12), luminance, 100 + 2 * k);
    dark.mean += pair.mean / 20;
    dark.variance += pair.variance / 20;
  }
  const double gain_dn_per_e = at(1).gain_dn_per_e();
  const double one_ms_e = (PatchOf(at(1e-3), luminance, 0).mean - dark.mean) / gain_dn_per_e;
  double xx = 0, xy = 0;
  for (int level = 1; level <= 20; ++level) {
    const Patch lit = PatchOf(at(1e-3 * 400 * level / one_ms_e), luminance, 2 * level);
    xx += std::pow(lit.mean - dark.mean, 2);
    xy += (lit.mean - dark.mean) * (lit.variance - dark.variance);
  }
  const double gain = xy / xx;
  EXPECT_NEAR(gain, (4095 - 64) / 10500.0, 0.03 * (4095 - 64) / 10500.0);
  EXPECT_NEAR(std::sqrt(dark.variance - 1.0 / 12) / gain, 6, 0.03 * 6);
  const double most = (PatchOf(at(1), luminance, 0).mean - dark.mean) / gain;
  EXPECT_NEAR(most, 10500, 0.03 * 10500);
}

// The wall brightens with the shutter's time, independent of the scene's exposure.
TEST_F(CameraBeforeAWall, AnImageSensorsExposureIsItsOwn) {
  camera_.image_sensor = ImageSensorModel{};
  camera_.image_sensor->exposure_s = 1e-4;
  const CameraFrame dim = Measure(camera_);
  camera_.image_sensor->exposure_s = 3e-4;
  const CameraFrame bright = Measure(camera_);
  EXPECT_GT(bright.rgb.at(80, 55, 1), dim.rgb.at(80, 55, 1) + 10);
  EXPECT_EQ(bright.instance.data, dim.instance.data);
  EXPECT_EQ(bright.depth_m.data, dim.depth_m.data);
}

// Two scenes, one with eight times the exposure: they differ to the eye, not to the sensor.
TEST_F(CameraBeforeAWall, WhatAnImageSensorSeesDoesNotFollowTheScenesExposure) {
  const CameraFrame plain = Measure(camera_);
  camera_.image_sensor = ImageSensorModel{.exposure_s = 3e-4};
  const CameraFrame sensed = Measure(camera_);
  model_.environment.exposure_ev100 -= 3;
  Rasterizer brighter(model_, {});
  const auto seen = [&](const CameraModel& model) {
    return Camera(model, {.rate_hz = 10}, 3'000'000, 1, "m/camera")
        .Measure(2, MakePose({1, 2, 1.5}, 0, 0, 90 * kDeg), scene_, &brighter);
  };
  EXPECT_EQ(seen(camera_).rgb.data, sensed.rgb.data);
  camera_.image_sensor.reset();
  EXPECT_NE(seen(camera_).rgb.data, plain.rgb.data);
}

}  // namespace
}  // namespace tera
