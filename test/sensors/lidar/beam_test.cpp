#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/faults.h"
#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/lidar/lidar.h"
#include "sensors/lidar/lidar_view.h"
#include "sensors/sensor.h"

// A beam with a width: range equation, pulse train, returns.

namespace tera {
namespace {

using testing::NoGround;
using testing::OneBodyEach;
using testing::WallMesh;

constexpr double kDivergence_rad = 0.003;
/// Half angle at 1/e^2 of the intensity of a Gaussian beam whose half power is `kDivergence_rad`
/// wide.
const double kHalfAngle_rad = kDivergence_rad / std::sqrt(2 * std::log(2.0));

/// One level beam with a width.
LidarModel WideBeam(int columns, int returns, const std::string& pick = "strongest") {
  LidarModel model;
  model.elevation_rad = {0};
  model.azimuth_offset_rad = {0};
  model.firing_offset_s = {0};
  model.columns = columns;
  model.range_at_10_percent_m = 100;
  model.beam = LidarBeam{.divergence_rad = kDivergence_rad, .returns = returns, .pick = pick};
  return model;
}

LidarScan ScanOf(const LidarModel& model, const RayScene& scene, const Pose& X_WS,
                 int threads = 1) {
  PoseTrack track;
  track.Append(0, X_WS);
  return Lidar(model, {.rate_hz = 10}, 0, 1, "m/lidar").Measure(0, track, scene, threads);
}

/// A wall to the left of y = 0 at `near_m`, and a wall behind everything at `far_m`, before a
/// sensor that looks along +x from the origin.
LidarScan ScanOfEdge(const LidarModel& model, double near_m, double far_m) {
  RayScene scene(OneBodyEach({WallMesh(3, 0.5), WallMesh(20, 0.5)}));
  scene.Update({{MakePose({near_m, 3, 0}), MakePose({far_m, 0, 0})}}, NoGround());
  return ScanOf(model, scene, Pose::Identity());
}

double RangeOf(const LidarPoint& p) { return Vec3(p.x_m, p.y_m, p.z_m).norm(); }

TEST(RangeEquation, MeetsBothPointsOfADataSheetsTable) {
  LidarModel model = WideBeam(360, 1);
  for (const bool has_beam : {false, true}) {
    if (!has_beam) model.beam.reset();
    model.range_at_10_percent_m = 90;
    model.range_at_80_percent_m = 170;
    const RangeEquation equation(model);
    EXPECT_NEAR(equation.LeastSurface(90), 0.1, 1e-12);
    EXPECT_NEAR(equation.LeastSurface(170), 0.8, 1e-12);
    EXPECT_NEAR(equation.Reach_m(0.1), 90, 1e-9);
    EXPECT_NEAR(equation.Reach_m(0.8), 170, 1e-9);
    for (const double reflectance : {0.02, 0.1, 0.3, 0.9}) {
      EXPECT_NEAR(equation.LeastSurface(equation.Reach_m(reflectance)), reflectance, 1e-9);
    }
  }
}

TEST(RangeEquation, OfABrightTargetAloneFallsWithTheSquareOfTheRange) {
  LidarModel model = WideBeam(360, 1);
  model.beam.reset();
  model.range_at_10_percent_m = 0;
  model.range_at_80_percent_m = 100;
  EXPECT_NEAR(RangeEquation(model).Reach_m(0.2), 50, 1e-9);
}

TEST(RangeEquation, WhereTheBeamIsTwiceAsWideAsFarAwayAQuarterOfTheLightMeetsTheDetector) {
  LidarModel model = WideBeam(360, 1);
  model.beam->aperture_m = 0.012;
  const RangeEquation equation(model);
  const double r_m = 0.012 / kDivergence_rad;
  EXPECT_NEAR(equation.Power(1, r_m), 0.25 / (r_m * r_m), 1e-12);
  EXPECT_NEAR(equation.Power(1, 1000) * 1e6, 1, 0.01);
  EXPECT_NEAR(equation.Reflectance(equation.Power(0.3, 2), 2), 0.3, 1e-12);
}

std::vector<Echo> PeaksOf(std::vector<Echo> echoes, double pulse_m) {
  std::vector<Echo> peaks;
  FindPeaks(&echoes, pulse_m, &peaks);
  return peaks;
}

TEST(PulseTrain, TwoEqualEchoesPartAtTwoStandardDeviations) {
  // The sum of two equal Gaussians has two maxima beyond 2 sigma; sigma is a full width at half
  // power over 2 sqrt(2 ln 2).
  const double pulse_m = 0.9, sigma_m = pulse_m / (2 * std::sqrt(2 * std::log(2.0)));
  const auto peaks = [&](double apart_m) {
    return PeaksOf({{20, 1, SemanticClass::kTruck, 1}, {20 + apart_m, 1, SemanticClass::kCone, 2}},
                   pulse_m);
  };
  const std::vector<Echo> one = peaks(1.95 * sigma_m);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].range_m, 20 + 0.975 * sigma_m, 0.01 * sigma_m);
  EXPECT_NEAR(one[0].power, 2 * std::exp(-0.5 * 0.975 * 0.975), 1e-3);
  const std::vector<Echo> two = peaks(2.1 * sigma_m);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].label, SemanticClass::kTruck);
  EXPECT_EQ(two[1].label, SemanticClass::kCone);
  EXPECT_EQ(two[1].instance, 2);
}

TEST(PulseTrain, NearEchoesShareTheirCentroidAndFarOnesKeepTheirRange) {
  // Within a tenth of the width the maximum is at the centroid, here a quarter of the way.
  const std::vector<Echo> near = PeaksOf({{10.06, 1}, {10, 3}}, 0.75);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_NEAR(near[0].range_m, 10.015, 2e-4);
  const std::vector<Echo> far = PeaksOf({{30, 0.2}, {10, 3}, {18, 1}}, 0.75);
  ASSERT_EQ(far.size(), 3u);
  EXPECT_EQ(far[0].range_m, 10);
  EXPECT_EQ(far[1].power, 1);
  EXPECT_EQ(far[2].range_m, 30);
}

TEST(LidarBeam, AtAnEdgeBothSurfacesReturnOverTheBeamsWidth) {
  const LidarModel model = WideBeam(60000, 2);
  const LidarScan scan = ScanOfEdge(model, 10, 20);
  int both = 0;
  for (std::size_t i = 1; i < scan.points.size(); ++i) {
    const LidarPoint &a = scan.points[i - 1], &b = scan.points[i];
    if (a.time_offset_ns != b.time_offset_ns || a.y_m > 1) continue;
    ++both;
    EXPECT_NEAR(std::min(RangeOf(a), RangeOf(b)), 10, 2e-3);
    EXPECT_NEAR(std::max(RangeOf(a), RangeOf(b)), 20, 2e-3);
  }
  // The beam's sides at 1/e^2 are 2 w apart.
  const double step_rad = 2 * kPi / model.columns;
  EXPECT_NEAR(both * step_rad, 2 * kHalfAngle_rad, 2 * step_rad);
}

TEST(LidarBeam, AtAnEdgeTheEnergyOfBothSurfacesIsThatOfTheBeam) {
  // Equal reflectances and little defocus: the intensities of both returns add up to 0.5.
  LidarModel model = WideBeam(60000, 2);
  model.beam->aperture_m = 1e-4;
  const LidarScan scan = ScanOfEdge(model, 10, 20);
  for (std::size_t i = 1; i < scan.points.size(); ++i) {
    const LidarPoint &a = scan.points[i - 1], &b = scan.points[i];
    if (a.time_offset_ns != b.time_offset_ns || a.y_m > 1) continue;
    EXPECT_NEAR(a.intensity + b.intensity, 0.5, 1e-3);
  }
}

TEST(LidarBeam, SurfacesWithinAPulseAreMixed) {
  // 0.3 m are less than 2 sigma of 0.75 m, 0.64 m: pixels on the edge lie between.
  const LidarScan scan = ScanOfEdge(WideBeam(60000, 3), 10, 10.3);
  int between = 0;
  std::uint32_t last_ns = 0;
  for (const LidarPoint& p : scan.points) {
    if (std::abs(p.y_m) > 0.2) continue;
    EXPECT_NE(p.time_offset_ns, last_ns) << "one return";
    last_ns = p.time_offset_ns;
    if (p.x_m > 10.005 && p.x_m < 10.295) ++between;
  }
  const double step_rad = 2 * kPi / 60000;
  EXPECT_NEAR(between * step_rad, 2 * kHalfAngle_rad, 2 * step_rad);
}

TEST(LidarBeam, PicksTheFirstTheLastOrTheStrongestEcho) {
  const auto ranges = [](const std::string& pick) {
    // The column whose axis hits the near wall 0.4 w from its edge.
    const LidarModel model = WideBeam(36000, 1, pick);
    std::vector<double> ranges_m;
    for (const LidarPoint& p : ScanOfEdge(model, 10, 20).points) {
      const double azimuth_rad = std::atan2(p.y_m, p.x_m);
      if (std::abs(azimuth_rad) < 0.9 * kHalfAngle_rad) ranges_m.push_back(RangeOf(p));
    }
    return ranges_m;
  };
  for (const double r_m : ranges("first")) EXPECT_NEAR(r_m, 10, 2e-3);
  for (const double r_m : ranges("last")) EXPECT_NEAR(r_m, 20, 2e-3);
  // With half of the energy on its axis, the beam's strongest echo comes from the surface on the
  // axis, or from the nearer wall, which returns four times as much per ray.
  for (const double r_m : ranges("strongest")) EXPECT_LT(std::min(r_m - 10, 20 - r_m), 2e-3);
}

TEST(LidarBeam, OnAPlainWallMeasuresWhatAThinRayDoes) {
  RayScene scene(OneBodyEach({WallMesh(20, 0.5)}));
  scene.Update({{MakePose({9, 0, 0}, 0, 0, 0.3)}}, NoGround());
  LidarModel model = WideBeam(720, 3);
  const Pose X_WS = MakePose({0.4, -0.2, 0.5}, 0.05, -0.04, 0.2);
  const LidarScan wide = ScanOf(model, scene, X_WS);
  model.beam.reset();
  const LidarScan thin = ScanOf(model, scene, X_WS);
  ASSERT_GT(thin.points.size(), 100u);
  std::size_t compared = 0;
  for (const LidarPoint& p : thin.points) {
    for (const LidarPoint& q : wide.points) {
      if (p.time_offset_ns != q.time_offset_ns || RangeOf(p) > 15) continue;
      ++compared;
      EXPECT_NEAR(RangeOf(p), RangeOf(q), 2e-3);
      EXPECT_NEAR(p.intensity, q.intensity, 5e-3);
    }
  }
  EXPECT_GT(compared, 100u);
}

TEST(LidarBeam, ScansDoNotDependOnTheNumberOfThreads) {
  RayScene scene(OneBodyEach({WallMesh(3, 0.5), WallMesh(20, 0.5)}));
  scene.Update({{MakePose({5, 3, 0}), MakePose({9, 0, 0})}}, NoGround());
  PoseTrack track;
  track.Append(0, Pose::Identity());
  const Lidar lidar(WideBeam(3600, 3), {.rate_hz = 10}, 0, 1, "m/lidar");
  const SensedAir air{nullptr, 20, 1, 60};
  const LidarScan one = lidar.Measure(0, track, scene, 1, air);
  const LidarScan two = lidar.Measure(0, track, scene, 2, air);
  ASSERT_GT(one.points.size(), 1000u);
  ASSERT_EQ(one.points.size(), two.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    ASSERT_EQ(std::memcmp(&one.points[i], &two.points[i], offsetof(LidarPoint, label) + 1), 0);
  }
}

TEST(LidarNoise, GrowsToItsLimitAsTheReturnWeakens) {
  // A 10 % wall at the dark target's range, and at half of it, where it returns four times as much
  // and the deviation of weak returns is halved. 4000 columns hit a wall of 20 m: 5 standard errors
  // of a deviation are 5 / sqrt(2 n).
  for (const double part : {0.999, 0.5}) {
    LidarModel model = WideBeam(20000, 1);
    model.beam.reset();
    model.range_at_10_percent_m = 40;
    model.range_noise_m = 0.006;
    model.range_noise_at_limit_m = 0.05;
    RayScene scene(OneBodyEach({WallMesh(0.5, 0.1)}));
    const double r_m = 40 * part;
    scene.Update({{MakePose({r_m, 0, 0})}}, NoGround());
    double squares_m2 = 0, count = 0;
    for (int k = 0; k < 20; ++k) {
      PoseTrack track;
      track.Append(0, Pose::Identity());
      const Lidar lidar(model, {.rate_hz = 10}, 0, 10 + k, "m/lidar");
      for (const LidarPoint& p : lidar.Measure(0, track, scene, 1).points) {
        if (std::abs(p.y_m) > 0.3) continue;
        squares_m2 += std::pow(RangeOf(p) - r_m * RangeOf(p) / p.x_m, 2);
        ++count;
      }
    }
    ASSERT_GT(count, 400);
    EXPECT_NEAR(std::sqrt(squares_m2 / count), std::hypot(0.006, 0.05 * part),
                0.051 * 5 / std::sqrt(2 * count));
  }
}

TEST(LidarBeam, RefusesWidthsOfNothingAndOfARadian) {
  const auto read = [](const std::string& beam) {
    const Config config = Config::FromText(
        "s: {name: l, type: lidar, link: b, elevation_deg: [0], columns: 8, "
        "rate_hz: 10, beam: " +
            beam + "}",
        "rig.yaml");
    ReadSensor(config.root().Map("s"));
    config.Finish();
  };
  using enum FaultKind;
  EXPECT_NO_THROW(read("{divergence_mrad: 3, returns: 3, pick: last}"));
  EXPECT_THAT([&] { read("{divergence_mrad: 0}"); },
              ThrowsFault(kOutOfRange, "s.beam.divergence_mrad"));
  EXPECT_THAT([&] { read("{returns: 2}"); }, ThrowsFault(kOutOfRange, "s.beam.divergence_mrad"));
  EXPECT_THAT([&] { read("{divergence_mrad: 1000}"); },
              ThrowsFault(kOutOfRange, "s.beam.divergence_mrad"));
  EXPECT_THAT([&] { read("{divergence_mrad: 3, sub_rays: 5}"); },
              ThrowsFault(kOutOfRange, "s.beam.sub_rays"));
}

}  // namespace
}  // namespace tera
