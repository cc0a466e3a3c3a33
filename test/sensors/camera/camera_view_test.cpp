#include "sensors/camera/camera_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/sensor.h"

namespace tera {
namespace {

using testing::Ground;
using testing::OneBodyEach;
using testing::WallMesh;

CameraModel Plain() {
  CameraModel model;
  model.intrinsics = {
      .width_px = 320, .height_px = 240, .fx_px = 250, .fy_px = 260, .cx_px = 150, .cy_px = 125};
  return model;
}

/// A lens with barrel distortion, and off its axis.
CameraModel Barrel() {
  CameraModel model = Plain();
  CameraIntrinsics& lens = model.intrinsics;
  lens.k1 = -0.25;
  lens.k2 = 0.06;
  lens.p1 = 0.004;
  lens.p2 = -0.003;
  lens.k3 = -0.003;
  return model;
}

CameraModel Pincushion() {
  CameraModel model = Plain();
  model.intrinsics.k1 = 0.2;
  return model;
}

CameraModel Wide() {
  CameraModel model = Plain();
  model.intrinsics.fx_px = 80;
  model.intrinsics.fy_px = 90;
  return model;
}

Vec3 DirectionOf(const CameraModel& model, double u_px, double v_px) {
  return OpticalInSensor().linear() * model.intrinsics.Unproject(Vec2(u_px, v_px)).normalized();
}

TEST(CameraView, HasAllPixelsInAllDirections) {
  // Over the sphere in rings about the sensor's x axis. The border of the picture cuts cells of
  // about 3 mrad x 9 mrad, so that a per mille of the picture is uncertain at the most.
  constexpr int kRings = 1200, kAround = 500;
  for (const CameraModel& model : {Plain(), Barrel(), Pincushion(), Wide()}) {
    ASSERT_FALSE(model.intrinsics.PixelWithoutRay());
    const ViewField field = ViewOf(model, 10);
    double sum = 0;
    for (int r = 0; r < kRings; ++r) {
      const double off_axis = kPi * (r + 0.5) / kRings;
      double ring = 0;
      for (int a = 0; a < kAround; ++a) {
        const double about = 2 * kPi * (a + 0.5) / kAround;
        const double side = std::sin(off_axis);
        const double density = field.per_steradian(
            Vec3(std::cos(off_axis), side * std::cos(about), side * std::sin(about)));
        ASSERT_GE(density, 0) << off_axis;
        ASSERT_TRUE(off_axis < 0.5 * kPi || density == 0) << "it sees behind itself";
        ring += density;
      }
      sum += ring * std::sin(off_axis);
    }
    const double pixels = 320 * 240;
    EXPECT_NEAR(sum * kPi / kRings * 2 * kPi / kAround, pixels, 0.004 * pixels)
        << model.intrinsics.k1;
  }
}

TEST(CameraView, DensityIsThatOfNeighbouringRays) {
  // The solid angle of the spherical triangles between rays through the corners of a pixel.
  for (const CameraModel& model : {Plain(), Barrel(), Pincushion(), Wide()}) {
    const ViewField field = ViewOf(model, 10);
    for (const Vec2& pixel : {Vec2(150, 125), Vec2(3, 4), Vec2(310, 20), Vec2(40, 230)}) {
      const Vec3 a = DirectionOf(model, pixel.x() - 0.5, pixel.y() - 0.5),
                 b = DirectionOf(model, pixel.x() + 0.5, pixel.y() - 0.5),
                 c = DirectionOf(model, pixel.x() + 0.5, pixel.y() + 0.5),
                 d = DirectionOf(model, pixel.x() - 0.5, pixel.y() + 0.5);
      // For small triangles, half of the cross product's length.
      const double steradian = 0.5 * ((b - a).cross(c - a).norm() + (c - a).cross(d - a).norm());
      const double density = field.per_steradian(DirectionOf(model, pixel.x(), pixel.y()));
      EXPECT_NEAR(density * steradian, 1, 2e-3) << pixel.transpose() << ", " << model.intrinsics.k1;
    }
  }
}

TEST(CameraView, EndsWhereThePictureDoes) {
  for (const CameraModel& model : {Plain(), Barrel(), Pincushion()}) {
    const ViewField field = ViewOf(model, 10);
    for (const double along : {0.1, 0.5, 0.9}) {
      const double u = 320 * along, v = 240 * along;
      EXPECT_GT(field.per_steradian(DirectionOf(model, u, 1)), 0);
      EXPECT_EQ(field.per_steradian(DirectionOf(model, u, -2)), 0);
      EXPECT_GT(field.per_steradian(DirectionOf(model, u, 238)), 0);
      EXPECT_EQ(field.per_steradian(DirectionOf(model, u, 241)), 0);
      EXPECT_GT(field.per_steradian(DirectionOf(model, 1, v)), 0);
      EXPECT_EQ(field.per_steradian(DirectionOf(model, -2, v)), 0);
      EXPECT_GT(field.per_steradian(DirectionOf(model, 318, v)), 0);
      EXPECT_EQ(field.per_steradian(DirectionOf(model, 321, v)), 0);
    }
  }
}

constexpr double kHalf_m = 0.6;
const Pose X_WS = MakePose({1, 2, 1.5}, 0.05, -0.1, 0.6);

double PixelsOnWall(const ViewField& field, const Pose& X_WG) {
  constexpr int kCells = 200;
  const double cell_m = 2 * kHalf_m / kCells;
  const Vec3 normal_W = X_WG.linear() * -Vec3::UnitX();
  double sum = 0;
  for (int a = 0; a < kCells; ++a) {
    for (int b = 0; b < kCells; ++b) {
      const Vec3 to_W =
          X_WG * Vec3(0, -kHalf_m + (a + 0.5) * cell_m, -kHalf_m + (b + 0.5) * cell_m) -
          X_WS.translation();
      const double r_m = to_W.norm(), cosine = -normal_W.dot(to_W) / r_m;
      sum += field.per_steradian(X_WS.linear().transpose() * to_W / r_m) * cosine / (r_m * r_m);
    }
  }
  return sum * cell_m * cell_m;
}

TEST(CameraView, PixelsOfASquareAreAsManyAsThePictureHas) {
  const SceneModel scene(OneBodyEach({WallMesh(kHalf_m, 0.5)}));
  const TerrainSurface ground = Ground(21, 21, 1, -10, [](double, double) { return -5.0; });
  Rasterizer rasterizer(scene, {});
  for (const CameraModel& model : {Plain(), Barrel(), Pincushion()}) {
    const ViewField field = ViewOf(model, 10);
    for (const Vec2& where : {Vec2(150, 120), Vec2(80, 75), Vec2(250, 170), Vec2(318, 120)}) {
      if (!model.intrinsics.p1 && where.x() != 80) continue;  // once without this lens
      // A square 3 m away about the ray through this pixel, skewed so that its edges cross rows and
      // columns. Its outline of some 400 pixels contributes sqrt(400) / 3 of ten thousand. The
      // picture's border cuts the last one.
      SceneState state;
      const Vec3 p_W = X_WS * (3 * DirectionOf(model, where.x(), where.y()));
      state.X_WB = {MakePose(p_W, X_WS.linear() * RotationFromRpy(0.35, 0.3, -0.25))};
      state.terrain = &ground;
      const CameraFrame frame =
          Camera(model, {.rate_hz = 10}, 0, 1, "m/camera").Measure(0, X_WS, state, &rasterizer);
      const auto pixels = static_cast<double>(
          std::count(frame.instance.data.begin(), frame.instance.data.end(), 1));
      EXPECT_GT(pixels, 3000);
      EXPECT_NEAR(PixelsOnWall(field, state.X_WB[0]), pixels, 0.01 * pixels)
          << where.transpose() << ", " << model.intrinsics.k1;
    }
  }
}

TEST(CameraView, SaysWhatItMeasures) {
  CameraModel model = Plain();
  model.depth = true;
  model.depth_min_m = 0.4;
  model.depth_max_m = 9;
  model.disparity_noise_px = 0.1;
  model.baseline_m = 0.05;
  const ViewField field = ViewOf(model, 5);
  EXPECT_EQ(field.samples, ViewField::Samples::kPixels);
  EXPECT_TRUE(field.ranges);
  EXPECT_EQ(field.nearest_m, model.intrinsics.near_m);
  EXPECT_EQ(field.min_distance_m, 0.4);
  EXPECT_EQ(field.max_distance_m, 9);
  // On the axis: a disparity of f b / z = 250 px 0.05 m / 4 m is off by 0.1 px.
  EXPECT_NEAR(field.distance_sigma_m(4), 4 * 0.1 / (250 * 0.05 / 4), 1e-9);
  EXPECT_EQ(field.samples_per_s, 320 * 240 * 5);
  EXPECT_GT(field.bytes_per_sample, 0);
  // Pictures reach the horizon, depth ends. A camera without pictures reaches no further than its
  // depth.
  EXPECT_EQ(field.reach_m(0.2), std::numeric_limits<double>::infinity());
  model.rgb = false;
  model.labels.reset();
  EXPECT_EQ(ViewOf(model, 5).nearest_m, 0.4);
  EXPECT_EQ(ViewOf(model, 5).reach_m(0.2), 9);
  model.rgb = true;
  model.depth = false;
  EXPECT_FALSE(ViewOf(model, 5).ranges);
  EXPECT_GT(field.bytes_per_sample, ViewOf(model, 5).bytes_per_sample);
}

TEST(CameraView, OnlyWhatSeesHasAView) {
  const auto has_view = [](const std::string& preset) {
    const Config config = Config::FromText(
        "s: {name: s, link: upper, preset: 'tera:config/sensors/" + preset + ".yaml'}", "test");
    const SensorDescription sensor = ReadSensor(config.root().Map("s"));
    config.Finish();
    return ViewOf(sensor).has_value();
  };
  EXPECT_TRUE(has_view("rgb_640"));
  EXPECT_TRUE(has_view("vlp16"));
  for (const std::string preset : {"icm_20948", "rtk_f9p", "inclinometer"}) {
    EXPECT_FALSE(has_view(preset)) << preset;
  }
}

}  // namespace
}  // namespace tera
