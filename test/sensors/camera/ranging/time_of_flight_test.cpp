#include "sensors/camera/ranging/time_of_flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

using testing::OneBodyEach;
using testing::WallMesh;

constexpr double kLight_mps = 299792458, kF_hz = 20e6;

double RangeOf_m(const Phasor& phasor) {
  const double phase = std::arg(phasor);
  return kLight_mps * (phase < 0 ? phase + 2 * kPi : phase) / (4 * kPi * kF_hz);
}

TEST(TimeOfFlight, LightOfAPatchHasItsDistanceAndFallsWithItsSquare) {
  const LitPatch patch{.p_C_m = {0, 1.2, 1.6}, .normal_C = {0, -0.6, -0.8}, .reflectance = 0.5};
  const Phasor light = DirectLight(patch, kF_hz);
  EXPECT_NEAR(RangeOf_m(light), 2, 1e-9);
  EXPECT_NEAR(std::abs(light), 0.5 / 4, 1e-12);
}

// Light via a patch: r = 3 m to it, then 2 m; it illuminates the point with rho E cos cos A / pi
// d^2.
TEST(TimeOfFlight, LightOverAPatchComesByItsWholeWay) {
  const LitPatch other{.p_C_m = {0, 0, 3},
                       .normal_C = Vec3(1, 0, -1).normalized(),
                       .reflectance = 0.6,
                       .area_m2 = 1e-6};
  const LitPatch at{.p_C_m = {2, 0, 3}, .normal_C = {-1, 0, 0}, .reflectance = 1};
  const Phasor light = LightOver({other}, at, kF_hz);
  const double cosine = std::sqrt(0.5);
  EXPECT_NEAR(std::abs(light), 0.6 * (cosine / 9) * cosine * 1e-6 / (kPi * 4),
              1e-6 * std::abs(light));
  EXPECT_NEAR(RangeOf_m(light), 5.0 / 2, 1e-9);
  const LitPatch turned{.p_C_m = {2, 0, 3}, .normal_C = {1, 0, 0}, .reflectance = 1};
  EXPECT_EQ(LightOver({other}, turned, kF_hz), Phasor(0));
}

/// Walls before a camera that looks along +x of W.
class CameraBeforeWalls : public ::testing::Test {
 protected:
  static CameraIntrinsics Lens() {
    return {
        .width_px = 96, .height_px = 72, .fx_px = 80, .fy_px = 80, .cx_px = 47.5, .cy_px = 35.5};
  }

  /// Reflectance at a pixel: pi times its luminance over its illuminance.
  static double Reflectance(const std::vector<Mesh>& meshes, const std::vector<Pose>& X_WB, int x,
                            int y) {
    const SceneModel model = OneBodyEach(meshes);
    Rasterizer rasterizer(model, {});
    SceneState state;
    state.X_WB = X_WB;
    LuminancePicture luminance{.white_cdpm2 = 4e4, .cdpm2 = {}};
    Image<float> light;
    rasterizer.Render(Lens(), MakePose({0, 0, 40}, 0, 0, 0) * OpticalInSensor(), state, {},
                      &luminance, nullptr, &light);
    const Image<float>& rgb = luminance.cdpm2;
    const double cdpm2 = 0.2126 * double(rgb.at(x, y, 0)) + 0.7152 * double(rgb.at(x, y, 1)) +
                         0.0722 * double(rgb.at(x, y, 2));
    return kPi * cdpm2 / double(light.at(x, y, 0));
  }

  Image<float> Measure(const std::vector<Mesh>& meshes, const std::vector<Pose>& X_WB,
                       const TimeOfFlightModel& tof) {
    const SceneModel model = OneBodyEach(meshes);
    Rasterizer rasterizer(model, {});
    SeenScene seen;
    seen.X_WC = MakePose({0, 0, 40}, 0, 0, 0) * OpticalInSensor();
    seen.state.X_WB = X_WB;
    return TimeOfFlight(tof, Lens(), 1, "m/camera").Measure(0, seen, &rasterizer);
  }
  static TimeOfFlightModel Plain() { return {.multipath = false, .noise = 0}; }
};

TEST_F(CameraBeforeWalls, AWallIsMeasuredModuloTheAmbiguityRange) {
  constexpr double kAmbiguity_m = 7.4948;  // half a wavelength of 20 MHz
  for (const double z_m : {3.0, 7.0, 9.0}) {
    const Image<float> depth_m = Measure({WallMesh(20, 0.5)}, {MakePose({z_m, 0, 40})}, Plain());
    for (const auto& [x, y] : {std::pair{47, 35}, {5, 5}, {90, 60}}) {
      const double ray = Lens().Unproject(Vec2(x, y)).norm();
      const double expected_m = std::fmod(z_m * ray, kAmbiguity_m) / ray;
      EXPECT_NEAR(depth_m.at(x, y), expected_m, 2e-3) << z_m;
    }
  }
}

// The left edge of a square at 2 m divides a column of pixels at a third: six of nine parts show
// the square, three the wall at 4 m. Both have one material, so that amplitudes scale as 1 / r^2.
TEST_F(CameraBeforeWalls, AtAnEdgePixelsFlyBetweenBothSurfaces) {
  const double edge_px = 40 - 0.5 + 1.0 / 3, half_m = 1, near_m = 2, far_m = 4;
  const double left_m = -(edge_px - 47.5) / 80 * near_m;  // along +y of W, to the left
  const Image<float> depth_m =
      Measure({WallMesh(half_m, 0.5), WallMesh(20, 0.5)},
              {MakePose({near_m, left_m - half_m, 40}), MakePose({far_m, 0, 40})}, Plain());
  const double ray = Lens().Unproject(Vec2(40, 35)).norm();
  const auto light = [&](double z_m) {
    return std::polar(1 / (z_m * z_m), 4 * kPi * kF_hz * z_m * ray / kLight_mps);
  };
  const double mixed_m = RangeOf_m(6.0 * light(near_m) + 3.0 * light(far_m)) / ray;
  ASSERT_GT(mixed_m, near_m + 0.1);
  EXPECT_NEAR(depth_m.at(40, 35), mixed_m, 0.03);
  EXPECT_NEAR(depth_m.at(39, 35), far_m, 0.01);
  EXPECT_NEAR(depth_m.at(41, 35), near_m, 0.01);
  TimeOfFlightModel one = Plain();
  one.parts = 1;
  const Image<float> sharp_m =
      Measure({WallMesh(half_m, 0.5), WallMesh(20, 0.5)},
              {MakePose({near_m, left_m - half_m, 40}), MakePose({far_m, 0, 40})}, one);
  EXPECT_NEAR(sharp_m.at(40, 35), near_m, 0.01);
}

// A corner of two walls, the camera 3 m before it. The reference integrates the other wall's
// contribution over a fine grid.
TEST_F(CameraBeforeWalls, InACornerTheWayOverTheOtherWallIsAdded) {
  const double half_m = 1.5;
  const Vec3 corner_W_m(4, 0, 40);
  // Each wall spans from the corner towards the camera at 45 degrees, facing the other.
  const Pose X_WL =
      MakePose(corner_W_m + half_m * Vec3(-std::sqrt(0.5), std::sqrt(0.5), 0), 0, 0, 45 * kDeg);
  const Pose X_WR =
      MakePose(corner_W_m + half_m * Vec3(-std::sqrt(0.5), -std::sqrt(0.5), 0), 0, 0, -45 * kDeg);
  TimeOfFlightModel with = Plain();
  with.multipath = true;
  const std::vector<Mesh> walls = {WallMesh(half_m, 0.5), WallMesh(half_m, 0.5)};
  const Image<float> direct_m = Measure(walls, {X_WL, X_WR}, Plain());
  const Image<float> found_m = Measure(walls, {X_WL, X_WR}, with);

  const int x = 66, y = 35;  // on the right wall
  const Vec3 ray_C = Lens().Unproject(Vec2(x, y));
  const Pose X_CW = (MakePose({0, 0, 40}, 0, 0, 0) * OpticalInSensor()).inverse();
  const Vec3 at_C_m = double(direct_m.at(x, y)) * ray_C;
  const Vec3 n_R_C = X_CW.linear() * X_WR.linear() * -Vec3::UnitX();
  const Vec3 n_L_C = X_CW.linear() * X_WL.linear() * -Vec3::UnitX();
  const double rho = Reflectance(walls, {X_WL, X_WR}, 30, 35), r_m = at_C_m.norm();
  EXPECT_NEAR(rho, 0.5, 0.1);  // a mesh without a colour, with its sheen
  Phasor over = 0;
  constexpr int kFine = 300;
  for (int a = 0; a < kFine * kFine; ++a) {
    const Vec3 p_L(0, half_m * (2 * (a % kFine + 0.5) / kFine - 1),
                   half_m * (2 * (a / kFine + 0.5) / kFine - 1));
    const Vec3 p_C_m = X_CW * (X_WL * p_L), way_m = at_C_m - p_C_m;
    // Only surfaces visible to the camera are lit and counted.
    const Vec2 pixel_px = Lens().Project(p_C_m);
    if (pixel_px.x() < -0.5 || pixel_px.y() < -0.5 || pixel_px.x() > 95.5 || pixel_px.y() > 71.5)
      continue;
    const double r1_m = p_C_m.norm(), d_m = way_m.norm();
    const double lit = std::max(0.0, n_L_C.dot(-p_C_m / r1_m)) / (r1_m * r1_m);
    const double area_m2 = std::pow(2 * half_m / kFine, 2);
    over += rho * lit * std::max(0.0, n_L_C.dot(way_m / d_m)) *
            std::max(0.0, n_R_C.dot(-way_m / d_m)) * area_m2 / (kPi * d_m * d_m) *
            std::polar(1.0, 2 * kPi * kF_hz * (r1_m + d_m) / kLight_mps);
  }
  const Phasor direct =
      n_R_C.dot(-at_C_m / r_m) / (r_m * r_m) * std::polar(1.0, 4 * kPi * kF_hz * r_m / kLight_mps);
  const Phasor all = direct + over * std::polar(1.0, 2 * kPi * kF_hz * r_m / kLight_mps);
  const double beyond_m = (RangeOf_m(all) - RangeOf_m(direct)) / ray_C.norm();
  ASSERT_GT(beyond_m, 0.01);
  const double found_beyond_m = double(found_m.at(x, y)) - double(direct_m.at(x, y));
  EXPECT_NEAR(found_beyond_m, beyond_m, 0.05 * beyond_m);
}

// Both of a phasor's numbers off by sigma make the phase off by sigma / amplitude.
TEST_F(CameraBeforeWalls, NoiseIsThatOfThePhasorsPhase) {
  TimeOfFlightModel noisy = Plain();
  noisy.parts = 1;
  noisy.noise = 1e-3;
  const Image<float> clean_m = Measure({WallMesh(20, 0.5)}, {MakePose({3, 0, 40})},
                                       {.parts = 1, .multipath = false, .noise = 0});
  const Image<float> depth_m = Measure({WallMesh(20, 0.5)}, {MakePose({3, 0, 40})}, noisy);
  double squares = 0, expected = 0;
  int count = 0;
  for (int y = 20; y < 52; ++y) {
    for (int x = 30; x < 66; ++x, ++count) {
      const double ray = Lens().Unproject(Vec2(x, y)).norm(), r_m = 3 * ray;
      squares += std::pow(ray * double(depth_m.at(x, y) - clean_m.at(x, y)), 2);
      expected += std::pow(r_m * r_m * ray, 2);  // over reflectance: 1 / amplitude
    }
  }
  const double sigma_m = std::sqrt(squares / count);
  const double per_reflectance_m =
      kLight_mps / (4 * kPi * kF_hz) * 1e-3 * std::sqrt(expected / count);
  const double reflectance = per_reflectance_m / sigma_m;  // 1152 pixels: to 2 %, 3 sigma 6 %
  EXPECT_GT(reflectance, 0.45);
  EXPECT_LT(reflectance, 0.65);  // with its sheen
}

// The air returns light from nearby, with a phase near zero. It makes a wall within half of the
// ambiguity range appear nearer, the more so the weaker the wall's own light.
TEST_F(CameraBeforeWalls, FogDrawsAWallNearer) {
  const auto depth_m = [](double visibility_m) {
    SceneModel model = OneBodyEach({WallMesh(20, 0.5)});
    model.environment.weather.visibility_m = visibility_m;
    Rasterizer rasterizer(model, {});
    SeenScene seen;
    seen.X_WC = MakePose({0, 0, 40}, 0, 0, 0) * OpticalInSensor();
    seen.state.X_WB = {MakePose({2.5, 0, 40})};
    return double(
        TimeOfFlight(Plain(), Lens(), 1, "m/camera").Measure(0, seen, &rasterizer).at(47, 35));
  };
  const double clear_m = depth_m(0), haze_m = depth_m(300), fog_m = depth_m(50);
  EXPECT_NEAR(clear_m, 2.5, 2e-3);
  EXPECT_LT(haze_m, clear_m - 0.01);
  EXPECT_LT(fog_m, haze_m - 0.05);
}

}  // namespace
}  // namespace tera
