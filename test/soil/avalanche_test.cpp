#include "soil/avalanche.h"

#include <gtest/gtest.h>

#include <cmath>

#include "soil/soil_type.h"
#include "soil_fixture.h"

namespace tera {
namespace {

using testing_soil::kStep_s;
using testing_soil::LevelColumns;

SoilType Shipped(const std::string& name) {
  const Config config = Config::FromFile(*ShippedSoilFile(name));
  return ReadSoilType(config.root());
}

void Settle(Columns* ground, Avalanche* avalanche, int steps) {
  for (int k = 0; k < steps; ++k) avalanche->Flow(kStep_s, ground);
}

/// Slope angle of a straight line fitted to heights between 20 % and 80 % of the top along a ray.
double FlankAngle_deg(const Columns& ground, double azimuth_rad) {
  const double top_m = ground.HeightAt(0, 0);
  std::vector<Vec2> points;
  for (double r = 0; r < 3; r += 0.01) {
    const double z = ground.HeightAt(r * std::cos(azimuth_rad), r * std::sin(azimuth_rad));
    if (z > 0.2 * top_m && z < 0.8 * top_m) points.push_back({r, z});
  }
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : points) mean += p / points.size();
  double sxy = 0, sxx = 0;
  for (const Vec2& p : points) {
    sxy += (p - mean).x() * (p - mean).y();
    sxx += (p - mean).x() * (p - mean).x();
  }
  return std::atan(-sxy / sxx) / kDeg;
}

TEST(Avalanche, PouredPileStandsAtReposeAlongAxesAndDiagonals) {
  for (const double cell_m : {0.05, 0.10}) {
    const SoilType sand = Shipped("sand");
    Columns ground = LevelColumns(sand, cell_m, static_cast<int>(6 / cell_m) + 1);
    Avalanche avalanche(ground.soils());
    const int mid = ground.nx() / 2;
    double poured_kg = 0;
    for (int k = 0; k < 6000; ++k) {  // 0.6 m^3 over an area of 15 cm
      for (int b = -1; b <= 1; ++b) {
        for (int a = -1; a <= 1; ++a) {
          const double volume_m3 = 0.6 / 6000 / 9;
          ground.Deposit(ground.Touch(mid + a, mid + b),
                         Spoil{volume_m3 * LooseDensity_kgpm3(sand), volume_m3, 0, 0});
          poured_kg += volume_m3 * LooseDensity_kgpm3(sand);
        }
      }
      avalanche.Flow(kStep_s, &ground);
    }
    Settle(&ground, &avalanche, 5000);
    for (int k = 0; k < 8; ++k) {
      EXPECT_NEAR(FlankAngle_deg(ground, k * 45 * kDeg), sand.repose_angle_rad / kDeg, 1.0)
          << "azimuth " << 45 * k << " deg, cells of " << cell_m << " m";
    }
    EXPECT_NEAR(ground.GroundGain().net_kg / poured_kg, 1, 1e-10);
  }
}

TEST(Avalanche, APileComesToRestAndThenCostsNothing) {
  const SoilType dirt = Shipped("dirt");
  Columns ground = LevelColumns(dirt, 0.05, 81);
  Avalanche avalanche(ground.soils());
  ground.Deposit(ground.Touch(40, 40), Spoil{134, 0.1, 0, 0});
  Settle(&ground, &avalanche, 20000);
  EXPECT_EQ(avalanche.active_count(), 0u);
}

TEST(Avalanche, BothDiagonalsAndAxesFlowAlike) {
  const SoilType dirt = Shipped("dirt");
  Columns ground = LevelColumns(dirt, 0.05, 81);
  Avalanche avalanche(ground.soils());
  ground.Deposit(ground.Touch(40, 40), Spoil{134, 0.1, 0, 0});
  Settle(&ground, &avalanche, 500);
  for (int d = 1; d < 12; ++d) {
    const double h = ground.TopAt(40 + d, 40 + 2);
    EXPECT_NEAR(ground.TopAt(40 - d, 40 - 2), h, 1e-12);
    EXPECT_NEAR(ground.TopAt(40 + 2, 40 + d), h, 1e-12);
    EXPECT_NEAR(ground.TopAt(40 - 2, 40 + d), h, 1e-12);
  }
}

/// A pit with an upright wall `height_m` tall along x = 0 (low side at x > 0), then 10 s of time.
double WallTopAfter(const SoilType& soil, double height_m) {
  Columns ground = LevelColumns(soil, 0.05, 121);
  Avalanche avalanche(ground.soils());
  for (int j = 0; j < 121; ++j) {
    for (int i = 60; i < 121; ++i) {
      SpoilMix cut;
      ground.Cut(ground.Touch(i, j), -height_m, &cut);
    }
  }
  Settle(&ground, &avalanche, 5000);
  return ground.HeightAt(-0.1, 0);
}

TEST(Avalanche, CohesiveWallStandsToItsCriticalHeightOnly) {
  const SoilType dirt = Shipped("dirt");
  // Culmann for an upright wall: 4 c / (rho g) tan(45 deg + phi / 2).
  const double critical_m = 4 * 2100 / (1474 * kStandardGravity_mps2) * std::tan(65 * kDeg);
  EXPECT_NEAR(CulmannHeight_m(dirt, 90 * kDeg), critical_m, 1e-9);
  EXPECT_NEAR(WallTopAfter(dirt, 0.9 * critical_m), 0, 1e-9);
  EXPECT_LT(WallTopAfter(dirt, 1.3 * critical_m), -0.05);
}

TEST(Avalanche, SandWallSlumpsAtOnce) { EXPECT_LT(WallTopAfter(Shipped("sand"), 0.5), -0.03); }

}  // namespace
}  // namespace tera
