#include "soil/flow/avalanche.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "soil/flow/grains.h"
#include "soil/soil_fixture.h"

namespace tera {
namespace {

using testing_soil::kStep_s;
using testing_soil::LevelColumns;
using testing_soil::Shipped;

void Settle(Columns* ground, Avalanche* avalanche, int steps) {
  Grains grains(ground->soils(), 1);
  for (int k = 0; k < steps; ++k) {
    grains.Step(kStep_s, ground);
    avalanche->Flow(kStep_s, ground, &grains);
  }
}

/// Whether the next step has no column to visit.
bool IsQuiet(Columns* ground, const Avalanche& avalanche) {
  return avalanche.active_count() == 0 && ground->TakeChanged().empty();
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
    Grains grains(ground.soils(), 1);
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
      avalanche.Flow(kStep_s, &ground, &grains);
    }
    Settle(&ground, &avalanche, 5000);
    for (int k = 0; k < 8; ++k) {
      EXPECT_NEAR(FlankAngle_deg(ground, k * 45 * kDeg), sand.repose_angle_rad / kDeg, 1.0)
          << "azimuth " << 45 * k << " deg, cells of " << cell_m << " m";
    }
    EXPECT_NEAR(ground.GroundGain().net_kg / poured_kg, 1, 1e-10);
  }
}

/// Radius to which a cylinder of loose soil spreads, mean over 16 directions.
double Runout_m(const SoilType& soil, double cell_m, double radius_m, double height_m) {
  Columns ground = LevelColumns(soil, cell_m, 2 * static_cast<int>(4 * radius_m / cell_m) + 1);
  Avalanche avalanche(ground.soils());
  for (int j = 0; j < ground.ny(); ++j) {
    for (int i = 0; i < ground.nx(); ++i) {
      const double r_m = std::hypot(ground.x_m(i), ground.y_m(j));
      const double inside = std::clamp((radius_m - r_m) / cell_m + 0.5, 0.0, 1.0);
      const double volume_m3 = inside * height_m * ground.area_m2();
      ground.Deposit(ground.Touch(i, j), Spoil{volume_m3 * LooseDensity_kgpm3(soil), volume_m3});
    }
  }
  Settle(&ground, &avalanche, 3000);
  double sum_m = 0;
  for (int k = 0; k < 16; ++k) {
    const double azimuth_rad = k * kPi / 8;
    double end_m = 0;
    for (double r = 0; r < 3.9 * radius_m; r += 0.01 * radius_m) {
      const double z = ground.HeightAt(r * std::cos(azimuth_rad), r * std::sin(azimuth_rad));
      if (z > 0.004 * radius_m) end_m = r;
    }
    sum_m += end_m;
  }
  return sum_m / 16;
}

TEST(Avalanche, AColumnCollapsesAsFarAsLubeMeasured) {
  const SoilType sand = Shipped("sand");
  struct Size {
    double radius_m, cell_m;
  };
  for (const auto& [radius_m, cell_m] : {Size{0.25, 0.05}, Size{0.5, 0.05}, Size{1.0, 0.1}}) {
    for (const double aspect : {0.4, 0.8, 1.2, 1.6}) {
      const double share =
          Runout_m(sand, cell_m, radius_m, aspect * radius_m) / (radius_m * (1 + 1.24 * aspect));
      EXPECT_NEAR(share, 1, 0.10) << "height over radius " << aspect << ", radius " << radius_m
                                  << " m";
      RecordProperty(fmt::format("radius_{:g}_m_aspect_{:g}", radius_m, aspect),
                     fmt::format("{:+.1f} %", 100 * (share - 1)));
    }
  }
}

/// Ground on which 1.3 m^3 have fallen from 1.5 m within a time, out of a mouth of 1.2 x 0.6 m.
Columns Dumped(const SoilType& soil, double cell_m, double within_s) {
  constexpr double kDumped_m3 = 1.3;
  Columns ground = LevelColumns(soil, cell_m, 2 * static_cast<int>(4 / cell_m) + 1);
  Avalanche avalanche(ground.soils());
  Grains grains(ground.soils(), 1);
  const Stream random(2, "test/mouth");
  const int steps = static_cast<int>(within_s / kStep_s);
  for (int k = 0; k < steps + 4000; ++k) {
    if (k < steps) {
      const double x_m = 0.6 * (random.Uniform(k, 0) - 0.5), volume_m3 = kDumped_m3 / steps;
      SpoilMix spoil;
      spoil.Add(Spoil{volume_m3 * LooseDensity_kgpm3(soil), volume_m3});
      grains.Pour(spoil, Vec3(x_m, -0.6, 1.5), Vec3(x_m, 0.6, 1.5), Vec3::Zero(), &ground);
    }
    grains.Step(kStep_s, &ground);
    avalanche.Flow(kStep_s, &ground, &grains);
  }
  EXPECT_EQ(grains.count(), 0U);
  EXPECT_NEAR(ground.GroundGain().net_kg / (kDumped_m3 * LooseDensity_kgpm3(soil)), 1, 1e-9);
  return ground;
}

// Crumbs that stick to each other do not run out as dry grains do (Artoni et al. 2013).
TEST(Avalanche, MoistSoilDumpedByTheBucketfulLiesAtRepose) {
  for (const char* name : {"dirt", "wet_sand", "clay"}) {
    const SoilType soil = Shipped(name);
    for (const double cell_m : {0.05, 0.10}) {
      for (const double within_s : {0.2, 1.0, 2.0}) {
        const Columns ground = Dumped(soil, cell_m, within_s);
        double mean_deg = 0;
        for (int k = 0; k < 8; ++k) mean_deg += FlankAngle_deg(ground, k * 45 * kDeg) / 8;
        EXPECT_NEAR(mean_deg, soil.repose_angle_rad / kDeg, 3.0)
            << name << " within " << within_s << " s, cells of " << cell_m << " m";
        RecordProperty(fmt::format("{}_{:g}_s_{:g}_m_cells", name, within_s, cell_m),
                       fmt::format("{:+.1f} deg", mean_deg - soil.repose_angle_rad / kDeg));
      }
    }
  }
}

TEST(Avalanche, ACubeOfMoistSoilSetFreeComesToLieAtRepose) {
  const SoilType dirt = Shipped("dirt");
  Columns ground = LevelColumns(dirt, 0.05, 161);
  Avalanche avalanche(ground.soils());
  for (int j = 70; j <= 90; ++j) {  // 1.05 x 1.05 x 1.18 m, 1.3 m^3
    for (int i = 70; i <= 90; ++i) {
      const double volume_m3 = 1.18 * ground.area_m2();
      ground.Deposit(ground.Touch(i, j), Spoil{volume_m3 * LooseDensity_kgpm3(dirt), volume_m3});
    }
  }
  Settle(&ground, &avalanche, 4000);
  for (int k = 0; k < 8; ++k) {
    EXPECT_NEAR(FlankAngle_deg(ground, k * 45 * kDeg), dirt.repose_angle_rad / kDeg, 3.0)
        << "azimuth " << 45 * k << " deg";
  }
}

// Lube's law has no length scale, and the flow's friction has only the grains' size. The remaining
// scales are the cell and the time step.
TEST(Avalanche, ColumnsOfAllSizesRunOutAlike) {
  const SoilType sand = Shipped("sand");
  for (const double aspect : {0.4, 1.2}) {
    const double small = Runout_m(sand, 0.025, 0.25, 0.25 * aspect) / 0.25;
    const double large = Runout_m(sand, 0.2, 2.0, 2.0 * aspect) / 2.0;
    EXPECT_NEAR(small / (1 + 1.24 * aspect), 1, 0.10) << aspect;
    EXPECT_NEAR(large / (1 + 1.24 * aspect), 1, 0.10) << aspect;
    EXPECT_NEAR(large / small, 1, 0.06) << aspect;
  }
}

/// A slope of loose soil between repose and the angle at which it starts to flow, along y.
Columns MarginalSlope(const SoilType& soil) {
  Columns ground = LevelColumns(soil, 0.05, 121);
  const double slope = std::tan(soil.repose_angle_rad + 0.4 * kDeg);
  for (int j = 0; j < 121; ++j) {
    for (int i = 0; i < 121; ++i) {
      const double volume_m3 = (0.3 + slope * 0.05 * std::clamp(j - 30, 0, 50)) * ground.area_m2();
      ground.Deposit(ground.Touch(i, j), Spoil{volume_m3 * LooseDensity_kgpm3(soil), volume_m3});
    }
  }
  return ground;
}

TEST(Avalanche, AGrainOnAMarginalSlopeMovesLessThanTenTimesItsOwnVolume) {
  const SoilType sand = Shipped("sand");
  Columns ground = MarginalSlope(sand);
  Avalanche avalanche(ground.soils());
  Settle(&ground, &avalanche, 500);
  ASSERT_TRUE(IsQuiet(&ground, avalanche));
  std::vector<double> before_m;
  for (int j = 0; j < 121; ++j) {
    for (int i = 0; i < 121; ++i) before_m.push_back(ground.TopAt(i, j));
  }
  constexpr double kGrain_m3 = 1e-4;
  ground.Deposit(ground.Touch(60, 70), Spoil{0.134, kGrain_m3});
  Settle(&ground, &avalanche, 5000);
  double moved_m3 = 0;
  std::size_t k = 0;
  for (int j = 0; j < 121; ++j) {
    for (int i = 0; i < 121; ++i) {
      moved_m3 += 0.5 * std::abs(ground.TopAt(i, j) - before_m[k++]) * ground.area_m2();
    }
  }
  EXPECT_LT(moved_m3, 10 * kGrain_m3);
  EXPECT_TRUE(IsQuiet(&ground, avalanche));
}

TEST(Avalanche, APileComesToRestAndThenCostsNothing) {
  const SoilType dirt = Shipped("dirt");
  Columns ground = LevelColumns(dirt, 0.05, 81);
  Avalanche avalanche(ground.soils());
  ground.Deposit(ground.Touch(40, 40), Spoil{134, 0.1, 0, 0});
  Settle(&ground, &avalanche, 20000);
  EXPECT_TRUE(IsQuiet(&ground, avalanche));
}

TEST(Avalanche, BothDiagonalsAndAxesFlowAlike) {
  // The flow of moist crumbs amplifies the rounding of sums in another order: friction that rises
  // stops and starts faces.
  struct Case {
    const char* soil;
    double tolerance_m;
  };
  for (const auto& [name, tolerance_m] : {Case{"sand", 1e-12}, Case{"dirt", 1e-4}}) {
    const SoilType soil = Shipped(name);
    Columns ground = LevelColumns(soil, 0.05, 81);
    Avalanche avalanche(ground.soils());
    ground.Deposit(ground.Touch(40, 40), Spoil{134, 0.1, 0, 0});
    Settle(&ground, &avalanche, 500);
    for (int d = 1; d < 12; ++d) {
      const double h = ground.TopAt(40 + d, 40 + 2);
      EXPECT_NEAR(ground.TopAt(40 - d, 40 - 2), h, tolerance_m) << name;
      EXPECT_NEAR(ground.TopAt(40 + 2, 40 + d), h, tolerance_m) << name;
      EXPECT_NEAR(ground.TopAt(40 - 2, 40 + d), h, tolerance_m) << name;
    }
  }
}

}  // namespace
}  // namespace tera
