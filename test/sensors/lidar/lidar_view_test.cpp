#include "sensors/lidar/lidar_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/sensor.h"

namespace tera {
namespace {

using testing::NoGround;
using testing::OneBodyEach;
using testing::WallMesh;

/// Beams from `high_deg` down in even steps.
LidarModel EvenBeams(int beams, double high_deg, double step_deg, int columns) {
  LidarModel model;
  for (int b = 0; b < beams; ++b) model.elevation_rad.push_back((high_deg - b * step_deg) * kDeg);
  model.azimuth_offset_rad.assign(model.elevation_rad.size(), 0);
  model.firing_offset_s.assign(model.elevation_rad.size(), 0);
  model.columns = columns;
  return model;
}

/// Beams that are denser in the middle, as in some lidars.
LidarModel UnevenBeams() {
  LidarModel model = EvenBeams(0, 0, 0, 720);
  for (const double deg : {15.0, 11.0, 8.0, 5.0, 3.0, 2.0, 1.33, 0.67, 0.0, -0.67, -1.33, -2.0,
                           -4.0, -7.0, -13.0, -25.0}) {
    model.elevation_rad.push_back(deg * kDeg);
  }
  model.azimuth_offset_rad.assign(model.elevation_rad.size(), 0);
  model.firing_offset_s.assign(model.elevation_rad.size(), 0);
  return model;
}

LidarModel ViewPreset(const std::string& name) {
  const Config config = Config::FromText(
      "s: {name: lidar, link: upper, preset: 'tera:config/sensors/" + name + ".yaml'}", "test");
  const SensorDescription sensor = ReadSensor(config.root().Map("s"));
  config.Finish();
  return std::get<LidarModel>(sensor.model);
}

Vec3 Direction(double elevation_rad, double azimuth_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

/// Over the sphere, in stripes of equal area.
double PointsInAll(const ViewField& field) {
  constexpr int kStripes = 20000, kAround = 4;
  double sum = 0;
  for (int s = 0; s < kStripes; ++s) {
    const double elevation = std::asin(-1 + 2 * (s + 0.5) / kStripes);
    for (int a = 0; a < kAround; ++a) {
      sum += field.per_steradian(Direction(elevation, 2 * kPi * (a + 0.3) / kAround));
    }
  }
  return sum * 4 * kPi / (kStripes * kAround);
}

TEST(LidarView, HasAllPointsOfARevolutionInAllDirections) {
  for (const LidarModel& model :
       {EvenBeams(64, 20, 0.7, 512), EvenBeams(2, 5, 10, 100), UnevenBeams(), ViewPreset("vlp16"),
        ViewPreset("os1_128"), ViewPreset("os1_64"), EvenBeams(90, 89, 2, 360)}) {
    const double rays = static_cast<double>(model.elevation_rad.size()) * model.columns;
    EXPECT_NEAR(PointsInAll(ViewOf(model, 10)), rays, 2e-3 * rays) << model.elevation_rad.size();
  }
}

TEST(LidarView, OfOneBeamOrOfTwoAtOneElevationIsFinite) {
  LidarModel twice = EvenBeams(4, 10, 5, 100);
  twice.elevation_rad[1] = twice.elevation_rad[0];
  for (const LidarModel& model : {EvenBeams(1, 0, 1, 360), twice}) {
    const ViewField field = ViewOf(model, 10);
    for (double deg = -90; deg <= 90; deg += 0.5) {
      const double points = field.per_steradian(Direction(deg * kDeg, 1));
      EXPECT_TRUE(std::isfinite(points) && points >= 0) << deg << ": " << points;
    }
  }
  LidarModel cone = EvenBeams(2, 10, 5, 100);
  cone.elevation_rad[1] = cone.elevation_rad[0];
  EXPECT_TRUE(ViewOf(cone, 10).is_flat);
  EXPECT_TRUE(ViewOf(EvenBeams(1, 0, 1, 360), 10).is_flat);
  EXPECT_FALSE(ViewOf(twice, 10).is_flat);
}

TEST(LidarView, PointsOnASurfaceThatFacesItAreThoseOfTheDataSheetsSteps) {
  // Beams every 2 deg and columns every 360 / 1808 deg. At range r they are r 2 deg apart in height
  // and r cos(e) 0.199 deg across.
  const ViewField field = ViewOf(ViewPreset("vlp16"), 10);
  for (const double elevation_deg : {-13.0, -7.3, 0.0, 1.0, 10.0}) {
    const double r_m = 7;
    const double apart_m2 =
        r_m * 2 * kDeg * r_m * std::cos(elevation_deg * kDeg) * 360 / 1808 * kDeg;
    for (const double azimuth_deg : {0.0, 100.0, -170.0}) {
      const Vec3 d_S = Direction(elevation_deg * kDeg, azimuth_deg * kDeg);
      // Within a cell of 2 deg, 1 / cos of its middle applies throughout: at 15 deg an error of
      // tan(15 deg) 1 deg, half a per cent.
      EXPECT_NEAR(field.per_steradian(d_S) / (r_m * r_m), 1 / apart_m2, 0.01 / apart_m2);
    }
  }
}

TEST(LidarView, LooksNowhereBeyondItsBeams) {
  const ViewField field = ViewOf(ViewPreset("vlp16"), 10);
  for (const double deg : {-90.0, -60.0, -17.0, 17.0, 45.0, 90.0}) {
    EXPECT_EQ(field.per_steradian(Direction(deg * kDeg, 0.4)), 0) << deg;
  }
}

/// A skewed wall of 6 m.
constexpr double kHalf_m = 3;
const Pose X_WWall = MakePose({8, 0.7, -0.4}, 0.35, 0.2, -0.3);

LidarScan Scan(const LidarModel& model, const Pose& X_WS, double reflectance = 0.5,
               const Pose& X_WG = X_WWall) {
  RayScene scene(OneBodyEach({WallMesh(kHalf_m, reflectance)}));
  scene.Update({{X_WG}}, NoGround());
  PoseTrack track;
  track.Append(0, X_WS);
  return Lidar(model, {.rate_hz = 10}, 0, 1, "m/lidar").Measure(0, track, scene, 1);
}

double PointsOnWall(const ViewField& field, const Pose& X_WS) {
  constexpr int kCells = 150;
  const double cell_m = 2 * kHalf_m / kCells;
  const Vec3 normal_W = X_WWall.linear() * -Vec3::UnitX();
  double sum = 0;
  for (int a = 0; a < kCells; ++a) {
    for (int b = 0; b < kCells; ++b) {
      const Vec3 p_W =
          X_WWall * Vec3(0, -kHalf_m + (a + 0.5) * cell_m, -kHalf_m + (b + 0.5) * cell_m);
      const Vec3 to_W = p_W - X_WS.translation();
      const double r_m = to_W.norm(), cosine = -normal_W.dot(to_W) / r_m;
      sum += field.per_steradian(X_WS.linear().transpose() * to_W / r_m) * cosine / (r_m * r_m);
    }
  }
  return sum * cell_m * cell_m;
}

TEST(LidarView, PointsOnAWallAreAsManyAsTheLidarMeasures) {
  // A skewed wall, so that its edges cross rows and columns of points. The count errs by the steps
  // of its outline: some 200 points are within half a step of it, and half of them count,
  // individually at random. sqrt(200) / 2 = 7 of thousands, and less over several attitudes.
  for (const LidarModel& model : {EvenBeams(128, 30, 0.5, 1024), ViewPreset("os1_128")}) {
    const ViewField field = ViewOf(model, 10);
    double measured = 0, expected = 0;
    for (int k = 0; k < 4; ++k) {
      const Pose X_WS = MakePose({0.3, -0.2, 0.5}, 0.1, -0.05 + 0.013 * k, 0.2 + 0.017 * k);
      measured += static_cast<double>(Scan(model, X_WS).points.size());
      expected += PointsOnWall(field, X_WS);
    }
    EXPECT_GT(measured, 10000);
    EXPECT_NEAR(expected, measured, 0.02 * measured);
  }
}

TEST(LidarView, UnevenBeamsHaveTheirPointsWhereTheyAre) {
  // Each beam's share of the sphere, the outer ones half a step beyond themselves, over attitudes
  // that take each beam over the wall's edges.
  const LidarModel model = UnevenBeams();
  const ViewField field = ViewOf(model, 10);
  double measured = 0, expected = 0;
  for (int k = 0; k < 12; ++k) {
    const Pose X_WS = MakePose({1, -0.2, 0.5}, 0.1, -0.4 + 0.068 * k, 0.2 + 0.017 * k);
    measured += static_cast<double>(Scan(model, X_WS).points.size());
    expected += PointsOnWall(field, X_WS);
  }
  EXPECT_GT(measured, 10000);
  EXPECT_NEAR(expected, measured, 0.02 * measured);
}

TEST(LidarView, ReachesAsFarAsTheLidarHasReturns) {
  LidarModel model = EvenBeams(64, 15, 0.5, 1024);
  model.range_at_10_percent_m = 6;
  model.max_range_m = 50;
  const ViewField field = ViewOf(model, 10);
  // The share of the light falls with the square of the range: a fourfold share doubles the range.
  EXPECT_NEAR(field.reach_m(0.1), 6, 1e-9);
  EXPECT_NEAR(field.reach_m(0.4), 12, 1e-9);
  EXPECT_EQ(field.reach_m(1e9), 50);
  EXPECT_EQ(field.reach_m(0), 0);
  for (const double reflectance : {0.05, 0.2, 0.8}) {
    for (const double off : {0.98, 1.02}) {
      // Head-on, of the middle only: elsewhere the range is larger and the incidence oblique.
      const double r_m = off * field.reach_m(reflectance);
      const LidarScan scan = Scan(model, Pose::Identity(), reflectance, MakePose({r_m, 0, 0}));
      EXPECT_EQ(scan.points.empty(), off > 1) << reflectance << " at " << r_m << " m";
    }
  }
}

TEST(LidarView, WithoutALimitOfPowerItReachesItsFarthestRange) {
  LidarModel model = EvenBeams(4, 3, 2, 100);
  model.max_range_m = 42;
  const ViewField field = ViewOf(model, 10);
  EXPECT_EQ(field.reach_m(0.01), 42);
  EXPECT_EQ(field.reach_m(1), 42);
}

TEST(LidarView, SaysWhatItMeasures) {
  LidarModel model = EvenBeams(16, 15, 2, 500);
  model.min_range_m = 0.7;
  model.max_range_m = 80;
  model.range_noise_m = 0.02;
  const ViewField field = ViewOf(model, 20);
  EXPECT_EQ(field.samples, ViewField::Samples::kPoints);
  EXPECT_TRUE(field.ranges);
  EXPECT_EQ(field.nearest_m, 0.7);
  EXPECT_EQ(field.min_distance_m, 0.7);
  EXPECT_EQ(field.max_distance_m, 80);
  EXPECT_EQ(field.distance_sigma_m(1), 0.02);
  EXPECT_EQ(field.distance_sigma_m(70), 0.02);
  EXPECT_EQ(field.samples_per_s, 16 * 500 * 20);
  EXPECT_GE(field.bytes_per_sample, 3 * sizeof(float));
}

TEST(LidarView, ReachInClearAirIsThatOfTheView) {
  for (const char* preset : {"os1_64", "os1_32", "vlp16", "hdl64e"}) {
    const LidarModel model = ViewPreset(preset);
    const ViewField field = ViewOf(model, 10);
    for (const double returned : {0.02, 0.1, 0.4, 0.9}) {
      EXPECT_NEAR(ReachInAir_m(model, {}, returned), field.reach_m(returned),
                  1e-6 * field.reach_m(returned))
          << preset;
    }
  }
}

// At a visibility of 100 m light falls by 50 within it, whatever its colour. A beam that reports
// two returns is not hidden by the fog's own.
TEST(LidarView, ReachInFogFallsByKoschmieder) {
  LidarModel model = EvenBeams(1, 0, 0, 360);
  model.range_at_10_percent_m = 60;
  model.max_range_m = 200;
  model.beam = LidarBeam{.divergence_rad = 0.003, .aperture_m = 1e-6, .returns = 2};
  for (const double returned : {0.05, 0.1, 0.5}) {
    const double reach_m = ReachInAir_m(model, {.visibility_m = 100}, returned);
    // returned 50^(-2 r / V) / r^2 is that of a tenth at 60 m.
    EXPECT_NEAR(returned * std::pow(50, -2 * reach_m / 100) / (reach_m * reach_m), 0.1 / 3600,
                2e-4 * 0.1 / 3600);
  }
  model.beam->returns = 1;
  model.beam->pick = "last";
  const double last_m = ReachInAir_m(model, {.visibility_m = 20}, 0.2);
  model.beam->pick = "strongest";
  const double strongest_m = ReachInAir_m(model, {.visibility_m = 20}, 0.2);
  model.beam->pick = "first";
  EXPECT_GT(last_m, strongest_m);
  EXPECT_GT(strongest_m, 0.5);
  EXPECT_LT(ReachInAir_m(model, {.visibility_m = 20}, 0.2), 1e-6);
}

// The fog's echo begins at a random place of a pulse's length and has noise, so that pulses part
// over some tenths of the range.
TEST(LidarView, ReachInFogIsWhereTheLidarsReturnsChangeFromWallToFog) {
  for (const char* preset : {"os1_64", "os1_32", "vlp16"}) {
    const LidarModel model = ViewPreset(preset);
    for (const double visibility_m : {50.0, 25.0}) {
      const SensedAir air{.visibility_m = visibility_m};
      const double reach_m = ReachInAir_m(model, air, 0.2);
      const auto seen = [&](double range_m) {
        RayScene scene(OneBodyEach({WallMesh(0.1 * range_m, 0.2)}));
        scene.Update({{MakePose({range_m, 0, 0})}}, NoGround());
        PoseTrack track;
        track.Append(0, Pose::Identity());
        const LidarScan scan =
            Lidar(model, {.rate_hz = 10}, 0, 1, "m/lidar").Measure(0, track, scene, 1, air);
        const LidarScan clear =
            Lidar(model, {.rate_hz = 10}, 0, 1, "m/lidar").Measure(0, track, scene, 1);
        const auto walls =
            std::count_if(scan.points.begin(), scan.points.end(), [](const LidarPoint& p) {
              return p.label == static_cast<std::uint8_t>(SemanticClass::kStructure);
            });
        return static_cast<double>(walls) / static_cast<double>(clear.points.size());
      };
      EXPECT_GT(seen(0.75 * reach_m), 0.9) << preset << " " << visibility_m << " " << reach_m;
      EXPECT_LT(seen(1.25 * reach_m), 0.1) << preset << " " << visibility_m << " " << reach_m;
    }
  }
}

}  // namespace
}  // namespace tera
