#include "sensors/lidar/air_echoes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "render/air/dust_box.h"
#include "render/air/rain.h"
#include "render/hand_made_scene.h"
#include "sensors/lidar/lidar.h"

namespace tera {
namespace {

using testing::DustBox;
using testing::NoGround;
using testing::OneBodyEach;
using testing::WallMesh;

/// One level beam all around that detects a 10 % target at 50 m.
LidarModel OneBeam() {
  LidarModel model;
  model.elevation_rad = {0};
  model.azimuth_offset_rad = {0};
  model.firing_offset_s = {0};
  model.columns = 3600;
  model.range_at_10_percent_m = 50;
  return model;
}

LidarScan Scan(const LidarModel& model, const SensedAir& air, double wall_x_m) {
  RayScene scene(OneBodyEach({WallMesh(40, 0.5)}));
  scene.Update({{MakePose({wall_x_m, 0, 0})}}, NoGround());
  PoseTrack track;
  track.Append(0, MakePose({2, 1, 0}));
  return Lidar(model, {.rate_hz = 10}, 0, 1, "m/lidar").Measure(0, track, scene, 1, air);
}

const LidarPoint* Ahead(const LidarScan& scan) {
  for (const LidarPoint& p : scan.points) {
    if (p.x_m > 0 && std::abs(p.y_m) < 1e-3 * p.x_m) return &p;
  }
  return nullptr;
}

TEST(AirEchoes, DustDimsAWallTwiceByBeerAndLambert) {
  // 6 m of 0.05 / m before a wall at 20 m: exp(-2 0.3) of its 50 % remains.
  const DustVolume dust = DustBox(Vec3(8, -40, -4), 0.5, {12, 160, 16}, 0.05);
  const LidarScan clear = Scan(OneBeam(), {}, 22), dusty = Scan(OneBeam(), {&dust, 0}, 22);
  ASSERT_NE(Ahead(clear), nullptr);
  ASSERT_NE(Ahead(dusty), nullptr);
  EXPECT_NEAR(Ahead(clear)->intensity, 0.5, 1e-4);
  EXPECT_NEAR(Ahead(dusty)->intensity, 0.5 * std::exp(-0.6), 0.01);
  EXPECT_EQ(Ahead(dusty)->label, static_cast<int>(SemanticClass::kStructure));
}

TEST(AirEchoes, ThickDustReturnsItselfNearItsFront) {
  // 2 / m: the wall behind 6 m of it is gone (exp(-24)). The front returns like a surface of pi (2
  // / 50) 0.75 = 0.094, minus the loss in the dust before it. At 6 m, 0.1 of ((6 + 3.67) / (50 +
  // 3.67))^2 suffices: 0.0032.
  const DustVolume dust = DustBox(Vec3(8, -40, -4), 0.5, {12, 160, 16}, 2);
  const LidarScan scan = Scan(OneBeam(), {&dust, 0}, 22);
  const LidarPoint* ahead = Ahead(scan);
  ASSERT_NE(ahead, nullptr);
  EXPECT_EQ(ahead->label, static_cast<int>(SemanticClass::kDust));
  EXPECT_EQ(ahead->instance, 0);
  EXPECT_NEAR(ahead->x_m, 6, 0.6);
  EXPECT_LT(ahead->intensity, 0.094);
  EXPECT_GT(ahead->intensity, 0.01);
}

TEST(AirEchoes, ThinDustFarAwayReturnsNothing) {
  // 0.02 / m equals a surface of 0.00094; at 6 m 0.0032 is needed, and there is no wall.
  const DustVolume dust = DustBox(Vec3(8, -40, -4), 0.5, {12, 160, 16}, 0.02);
  EXPECT_TRUE(Scan(OneBeam(), {&dust, 0}, -400).points.empty());
}

TEST(AirEchoes, ClearAirChangesNoByte) {
  const DustVolume none;
  const LidarScan clear = Scan(OneBeam(), {}, 22), empty = Scan(OneBeam(), {&none, 0}, 22);
  ASSERT_EQ(clear.points.size(), empty.points.size());
  for (std::size_t i = 0; i < clear.points.size(); ++i) {
    EXPECT_EQ(clear.points[i].x_m, empty.points[i].x_m);
    EXPECT_EQ(clear.points[i].intensity, empty.points[i].intensity);
  }
}

TEST(AirEchoes, RainDimsByItsExtinctionAndReturnsMoreOftenTheHarderItFalls) {
  const auto drops = [](const LidarScan& scan) {
    int count = 0;
    for (const LidarPoint& p : scan.points) {
      if (p.label == static_cast<int>(SemanticClass::kRain)) ++count;
    }
    return count;
  };
  // No wall ahead: only drops return.
  const int light = drops(Scan(OneBeam(), {nullptr, 2}, -400));
  const int heavy = drops(Scan(OneBeam(), {nullptr, 40}, -400));
  EXPECT_GT(light, 0);
  EXPECT_GT(heavy, 2 * light);
  EXPECT_LT(heavy, 3600);
  const LidarScan wall = Scan(OneBeam(), {nullptr, 40}, 22);
  double intensity = 0, two_way = std::exp(-2 * 20 * Rain(40).Extinction_1pm());
  for (const LidarPoint& p : wall.points) {
    if (p.label == static_cast<int>(SemanticClass::kStructure) && std::abs(p.y_m) < 0.1) {
      intensity = p.intensity;
    }
  }
  EXPECT_NEAR(intensity, 0.5 * two_way, 0.005);
}

TEST(AirEchoes, TheNumberOfDropsSeenIsThatOfThePoissonProcess) {
  // Drops large enough for the threshold, by a sum over shells of the beam: a drop of diameter D in
  // a beam of area A returns pi^2 D^2 / (2 S A). At close range the receiver sees (D r / (d + D
  // r))^2 of that. It must reach the return of a 10 % target at 50 m.
  const double rate_mmph = 30;
  const Rain rain(rate_mmph);
  double expected = 0;
  for (double r_m = 0.3; r_m < 40; r_m += 0.001) {
    const double beam_m = 0.011 + 0.003 * r_m, area_m2 = kPi / 4 * beam_m * beam_m;
    const auto overlap = [](double at_m) {
      return std::pow(0.003 * at_m / (0.011 + 0.003 * at_m), 2);
    };
    const double least = 0.1 * r_m * r_m / 2500 * overlap(50) / overlap(r_m) *
                         std::exp(2 * rain.Extinction_1pm() * r_m);
    const double diameter_m = std::sqrt(least * 2 * 150 * area_m2) / kPi;
    if (diameter_m < 0.006) expected += area_m2 * rain.CountAbove_1pm3(diameter_m) * 0.001;
  }
  const LidarScan scan = Scan(OneBeam(), {nullptr, rate_mmph}, -400);
  const double share = static_cast<double>(scan.points.size()) / 3600;
  const double seen = 1 - std::exp(-expected);
  EXPECT_NEAR(share, seen, 5 * std::sqrt(seen * (1 - seen) / 3600));
}

TEST(AirEchoes, FogDimsAWallByKoschmiedersLaw) {
  // 2 % of the contrast remains at the visibility. A wall at a fifth of it, with the way back, thus
  // keeps 50^(-2 / 5). In fog of 100 m the wavelength does not matter (Kim et al.).
  const LidarScan scan = Scan(OneBeam(), {.visibility_m = 100}, 22);
  ASSERT_NE(Ahead(scan), nullptr);
  EXPECT_NEAR(Ahead(scan)->intensity, 0.5 * std::pow(50, -0.4), 1e-4);
  // A haze of 8 km attenuates by (905 / 550)^-1.3 of its attenuation of visible light.
  const LidarScan haze = Scan(OneBeam(), {.visibility_m = 8000}, 22);
  const double visible = std::pow(50, -2 * 20 / 8000.0);
  EXPECT_NEAR(Ahead(haze)->intensity, 0.5 * std::pow(visible, std::pow(905 / 550.0, -1.3)), 1e-5);
}

TEST(AirEchoes, ThickFogReturnsItselfNearbyAndHidesWhatIsFar) {
  int near = 0;
  const LidarScan thick = Scan(OneBeam(), {.visibility_m = 25}, 42);
  for (const LidarPoint& p : thick.points) {
    EXPECT_EQ(p.label, static_cast<int>(SemanticClass::kRain));
    EXPECT_LT(std::hypot(p.x_m, p.y_m), 10);
    ++near;
  }
  // exp(-2 40 3.91 / 25) of the wall's light is below any threshold.
  EXPECT_GT(near, 3000);
  EXPECT_EQ(Scan(OneBeam(), {.visibility_m = 2000}, -400).points.size(), 0u);
}

TEST(AirEchoes, InFogReturnsOfTheLatestEchoAreSurfaces) {
  LidarModel model = OneBeam();
  model.beam = LidarBeam{.divergence_rad = 0.003, .pick = "last"};
  const LidarScan last = Scan(model, {.visibility_m = 40}, 14);
  ASSERT_NE(Ahead(last), nullptr);
  EXPECT_EQ(Ahead(last)->label, static_cast<int>(SemanticClass::kStructure));
  model.beam->pick = "first";
  const LidarScan first = Scan(model, {.visibility_m = 40}, 14);
  ASSERT_NE(Ahead(first), nullptr);
  EXPECT_EQ(Ahead(first)->label, static_cast<int>(SemanticClass::kRain));
}

TEST(AirEchoes, SnowfallDimsAndReturnsMoreThanRainOfTheSameWater) {
  const auto flakes = [](const SensedAir& air) { return Scan(OneBeam(), air, -400).points.size(); };
  EXPECT_GT(flakes({.snowfall_mmph = 2}), 2 * flakes({.rain_mmph = 2}));
  const LidarScan wall = Scan(OneBeam(), {.snowfall_mmph = 2}, 22);
  // Gunn and Marshall: pi 2.5^2 N0 / L^3 with 3800 2^-0.87 / (m^3 mm) and 2.55 2^-0.48 / mm.
  const double extinction_1pm =
      kPi * 6.25 * 3.8e6 * std::pow(2, -0.87) / std::pow(2550 * std::pow(2, -0.48), 3);
  double brightest = 0;
  for (const LidarPoint& p : wall.points) {
    if (p.label == static_cast<int>(SemanticClass::kStructure)) {
      brightest = std::max(brightest, double(p.intensity));
    }
  }
  EXPECT_NEAR(brightest, 0.5 * std::exp(-2 * 20 * extinction_1pm), 1e-3);
}

TEST(AirEchoes, SteadyRainHardlyReturnsAndADownpourNoOftenerThanIsReported) {
  // An OS1 in the open: almost no effect in moderate steady rain (the maker), and returns from 9 to
  // 13 % of the pulses at 25 mm/h (a field trial of an OS1-32: 80 to 120 in 10 deg of a scan).
  LidarModel os1 = OneBeam();
  os1.range_at_10_percent_m = 45;
  os1.columns = 36000;
  const auto share = [&](double mmph) {
    return static_cast<double>(Scan(os1, {.rain_mmph = mmph}, -400).points.size()) / 36000;
  };
  EXPECT_LT(share(2), 0.002);
  EXPECT_GT(share(25), 10 * share(2));
  EXPECT_LT(share(25), 0.13);
}

}  // namespace
}  // namespace tera
