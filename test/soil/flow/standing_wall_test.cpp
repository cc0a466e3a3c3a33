#include "soil/flow/standing_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "soil/block_fixture.h"
#include "soil/flow/avalanche.h"
#include "soil/flow/grains.h"
#include "soil/soil_fixture.h"

namespace tera {
namespace {

using testing_soil::kStep_s;
using testing_soil::LevelColumns;
using testing_soil::Shipped;

/// Terzaghi's height of an upright wall of config/soils/clay.yaml: 4 c / (rho g) tan(45 + phi / 2).
const double kClayStands_m = 4 * 4140 / (1790 * kStandardGravity_mps2) * std::tan(51.5 * kDeg);

/// A pit beside level ground at z = 0, behind an upright wall through W's origin.
struct Pit {
  /// Low where `out` points. `out` has length 1; soil 0 is `soil`.
  Pit(const SoilType& soil, double cell_m, double height_m, const Vec2& out, std::uint64_t seed = 1)
      : out(out),
        height_m(height_m),
        ground(LevelColumns(soil, cell_m, static_cast<int>(8 / cell_m) + 1)),
        avalanche(ground.soils()),
        grains(ground.soils(), seed) {
    const double middle_m = 0.5 * cell_m * (std::abs(out.x()) + std::abs(out.y()));
    for (int j = 0; j < ground.ny(); ++j) {
      for (int i = 0; i < ground.nx(); ++i) {
        if (Vec2(ground.x_m(i), ground.y_m(j)).dot(out) > middle_m) {
          ground.Cut(ground.Touch(i, j), -height_m, &cut);
        }
      }
    }
  }
  void Wait(double time_s) {
    for (int k = 0; k < std::lround(time_s / kStep_s); ++k) {
      grains.Step(kStep_s, &ground);
      avalanche.Flow(kStep_s, &ground, &grains);
      most_grains = std::max(most_grains, grains.count());
      if (k % 20 == 0) highest_m = std::max(highest_m, Highest_m());
    }
  }
  double Highest_m() const {
    double z_m = -height_m;
    for (int n = 0; n < ground.nx() * ground.ny(); ++n) {
      z_m = std::max(z_m, ground.TopAt(n % ground.nx(), n / ground.nx()));
    }
    return z_m;
  }
  /// Height `behind_m` behind the wall's face.
  double HeightBehind(double behind_m) const {
    const Vec2 p = -behind_m * out;
    return ground.HeightAt(p.x(), p.y());
  }
  /// The same without the loose soil there, at the nearest column.
  double BankBehind(double behind_m) {
    const Vec2 p = -behind_m * out;
    const Column& c = ground.at(ground.Touch(ground.NearestI(p.x()), ground.NearestJ(p.y())));
    return c.top_m - c.loose_m();
  }
  double Balance_kg() const {
    return ground.GroundGain().net_kg + cut.mass_kg() + grains.mass_kg() + ground.outside_kg();
  }

  Vec2 out;
  double height_m;
  Columns ground;
  Avalanche avalanche;
  Grains grains;
  SpoilMix cut;
  std::size_t most_grains = 0;
  double highest_m = -1e9;
};

struct Facing {
  const char* name;
  Vec2 out;
};
const std::vector<Facing> kFacings = {{"+x", {1, 0}},
                                      {"-y", {0, -1}},
                                      {"+x+y", {std::sqrt(0.5), std::sqrt(0.5)}},
                                      {"-x+y", {-std::sqrt(0.5), std::sqrt(0.5)}}};

TEST(StandingWall, ClayStandsToItsCriticalHeightAndFailsAboveIt) {
  const SoilType clay = Shipped("clay");
  EXPECT_NEAR(CulmannHeight_m(clay, 90 * kDeg), kClayStands_m, 1e-9);
  for (const double cell_m : {0.05, 0.10}) {
    for (const Facing& facing : kFacings) {
      SCOPED_TRACE(testing::Message() << facing.name << ", cells of " << cell_m << " m");
      Pit stands(clay, cell_m, 0.99 * kClayStands_m, facing.out);
      stands.Wait(3);
      EXPECT_EQ(stands.HeightBehind(2 * cell_m), 0);
      EXPECT_EQ(stands.most_grains, 0u);
      Pit fails(clay, cell_m, 1.01 * kClayStands_m, facing.out);
      fails.Wait(10);
      EXPECT_LT(fails.BankBehind(2 * cell_m), -0.5);
      EXPECT_LT(fails.HeightBehind(2 * cell_m), -0.2);
      EXPECT_EQ(fails.grains.count(), 0u);
    }
  }
}

TEST(StandingWall, WhatFailsOfClayIsTheWedgeAboveThePlaneThroughTheToe) {
  const double height_m = 1.3;
  // Plane at (90 deg + phi) / 2: it meets the ground this far behind the face.
  const double wedge_m = height_m / std::tan(51.5 * kDeg);
  for (const double cell_m : {0.05, 0.10}) {
    for (const Facing& facing : kFacings) {
      SCOPED_TRACE(testing::Message() << facing.name << ", cells of " << cell_m << " m");
      Pit pit(Shipped("clay"), cell_m, height_m, facing.out);
      pit.Wait(6);
      EXPECT_EQ(pit.HeightBehind(wedge_m + 1.5 * cell_m), 0);
      EXPECT_LT(pit.BankBehind(wedge_m - 3 * cell_m), -cell_m);
      EXPECT_NEAR(pit.BankBehind(0.5 * wedge_m), -0.5 * height_m, 2.2 * cell_m);
    }
  }
}

TEST(StandingWall, SandSlumpsAtOnceToItsSlope) {
  const SoilType sand = Shipped("sand");
  for (const double cell_m : {0.05, 0.10}) {
    for (const Facing& facing : kFacings) {
      SCOPED_TRACE(testing::Message() << facing.name << ", cells of " << cell_m << " m");
      Pit pit(sand, cell_m, 1.0, facing.out);
      pit.Wait(1.0);
      EXPECT_LT(pit.HeightBehind(cell_m), -0.2);
      pit.Wait(5.0);
      EXPECT_EQ(pit.grains.count(), 0u);
      // Nowhere steeper than internal friction, 39 deg; a column's edge may stand in for a slope.
      const double steepest = std::tan(39 * kDeg);
      for (double s_m = -1.5; s_m < 2; s_m += cell_m) {
        EXPECT_LT(pit.HeightBehind(s_m + 2 * cell_m) - pit.HeightBehind(s_m),
                  2 * cell_m * steepest + 0.5 * cell_m)
            << s_m;
      }
    }
  }
}

TEST(StandingWall, AClodOnAMarginalWallMovesLessThanTenTimesItsOwnVolume) {
  constexpr double kClod_m3 = 1e-4;
  const SoilType clay = Shipped("clay");
  for (const double cell_m : {0.05, 0.10}) {
    for (const double behind_m : {0.03, 0.2}) {
      Pit pit(clay, cell_m, 0.98 * kClayStands_m, Vec2(1, 0));
      pit.Wait(1);
      std::vector<double> before_m;
      for (int n = 0; n < pit.ground.nx() * pit.ground.ny(); ++n) {
        before_m.push_back(pit.ground.TopAt(n % pit.ground.nx(), n / pit.ground.nx()));
      }
      SpoilMix clod;
      clod.Add({0.128, kClod_m3, 0, 0});
      const Vec3 above_W(-behind_m, 0.2, 1);
      pit.grains.Pour(clod, above_W, above_W, Vec3::Zero(), &pit.ground);
      pit.Wait(5);
      double moved_m3 = 0;
      for (int n = 0; n < pit.ground.nx() * pit.ground.ny(); ++n) {
        const double top_m = pit.ground.TopAt(n % pit.ground.nx(), n / pit.ground.nx());
        moved_m3 += 0.5 * std::abs(top_m - before_m[n]) * pit.ground.area_m2();
      }
      EXPECT_GT(moved_m3, 0.1 * kClod_m3);
      EXPECT_LT(moved_m3, 10 * kClod_m3) << cell_m << " m, " << behind_m << " m behind the face";
    }
  }
}

TEST(StandingWall, WhatFallsOfClayIsClodsForAWhileAndLosesNoMass) {
  Pit pit(Shipped("clay"), 0.05, 1.4, Vec2(0, -1));
  const double scale_kg = pit.cut.mass_kg();
  for (int k = 0; k < 20; ++k) {
    pit.Wait(0.05);
    ASSERT_NEAR(pit.Balance_kg() / scale_kg, 0, 1e-12);
  }
  EXPECT_GT(pit.most_grains, 200u);
  EXPECT_LE(pit.most_grains, Grains::kMostClods);
  pit.Wait(6);
  EXPECT_EQ(pit.grains.count(), 0u);
  EXPECT_NEAR(pit.Balance_kg() / scale_kg, 0, 1e-12);
}

TEST(StandingWall, WhatFailsNeverStandsMoreThanACellHigherThanTheGroundDid) {
  // A little more than each can bear: clay 1.19 m, dirt 1.25 m, wet sand 2.2 m; sand nothing.
  const std::vector<std::pair<const char*, double>> kSoils = {
      {"clay", 1.4}, {"dirt", 1.5}, {"wet_sand", 2.6}, {"sand", 1.0}};
  for (const auto& [soil, height_m] : kSoils) {
    for (const Facing& facing : {kFacings[1], kFacings[3]}) {
      SCOPED_TRACE(testing::Message() << soil << ", " << facing.name);
      Pit pit(Shipped(soil), 0.10, height_m, facing.out);
      pit.Wait(4);
      EXPECT_LT(pit.HeightBehind(0.1), -0.2);
      EXPECT_LT(pit.highest_m, 0.1);
    }
  }
}

TEST(StandingWall, FailsAlikeWithTheSameSeedAndNotWithAnother) {
  const auto heights_m = [](std::uint64_t seed) {
    Pit pit(Shipped("clay"), 0.10, 1.5, Vec2(1, 0), seed);
    pit.Wait(4);
    std::vector<double> z_m;
    for (int n = 0; n < pit.ground.nx() * pit.ground.ny(); ++n) {
      z_m.push_back(pit.ground.TopAt(n % pit.ground.nx(), n / pit.ground.nx()));
    }
    return z_m;
  };
  const std::vector<double> once = heights_m(5);
  EXPECT_EQ(heights_m(5), once);
  EXPECT_NE(heights_m(6), once);
}

/// A pit of 2.4 m x 2.4 m with upright walls of clay, 1.4 m deep.
struct SquarePit {
  explicit SquarePit(double cell_m)
      : ground(LevelColumns(Shipped("clay"), cell_m, static_cast<int>(7 / cell_m) + 1)),
        avalanche(ground.soils()),
        grains(ground.soils(), 7) {
    SpoilMix cut;
    for (int j = 0; j < ground.ny(); ++j) {
      for (int i = 0; i < ground.nx(); ++i) {
        if (std::max(std::abs(ground.x_m(i)), std::abs(ground.y_m(j))) < 1.2) {
          ground.Cut(ground.Touch(i, j), -1.4, &cut);
        }
      }
    }
  }
  void Wait(double time_s) {
    for (int k = 0; k < std::lround(time_s / kStep_s); ++k) {
      grains.Step(kStep_s, &ground);
      avalanche.Flow(kStep_s, &ground, &grains);
    }
  }
  double Highest_m() const {
    double z_m = -1;
    for (int n = 0; n < ground.nx() * ground.ny(); ++n) {
      z_m = std::max(z_m, ground.TopAt(n % ground.nx(), n / ground.nx()));
    }
    return z_m;
  }
  /// Columns that stand more than 0.2 m higher than those on two opposite sides.
  int Slabs() {
    int slabs = 0;
    for (int j = 1; j + 1 < ground.ny(); ++j) {
      for (int i = 1; i + 1 < ground.nx(); ++i) {
        const auto lower = [&](int a, int b) {
          return ground.TopAt(i + a, j + b) < ground.TopAt(i, j) - 0.2;
        };
        slabs += (lower(-1, 0) && lower(1, 0)) || (lower(0, -1) && lower(0, 1));
      }
    }
    return slabs;
  }

  Columns ground;
  Avalanche avalanche;
  Grains grains;
};

TEST(StandingWall, APitThatFailsAllRoundLeavesNoSlabsAndNoHeapAboveTheGround) {
  for (const double cell_m : {0.05, 0.10}) {
    SCOPED_TRACE(cell_m);
    SquarePit pit(cell_m);
    pit.Wait(6);
    EXPECT_EQ(pit.grains.count(), 0u);
    EXPECT_EQ(pit.Slabs(), 0);
    EXPECT_LT(pit.Highest_m(), 0.05);
    EXPECT_LT(pit.ground.HeightAt(0, 0), -0.5);  // it slumps from the sides
  }
}

/// Level ground of strata, an upright wall of `height_m` across it, and what is left of it after
/// some seconds.
struct LayeredWall {
  LayeredWall(const std::vector<SoilType>& soils, const std::vector<double>& bottoms_m,
              double height_m)
      : ground(Plan(soils, bottoms_m), soils), avalanche(ground.soils()), grains(soils, 1) {
    for (int j = 0; j < 121; ++j) {
      for (int i = 61; i < 121; ++i) ground.Cut(ground.Touch(i, j), -height_m, &cut);
    }
  }
  static UndisturbedGround Plan(const std::vector<SoilType>& soils,
                                const std::vector<double>& bottoms_m) {
    UndisturbedGround plan;
    plan.grid = {.origin_W_m = Vec2(-3, -3), .cell_m = 0.05, .nx = 121, .ny = 121};
    plan.base_cells = TerrainGrid::kTileCells;
    plan.base_height_m.assign(static_cast<std::size_t>(plan.base_nx()) * plan.base_ny(), 0.0);
    std::vector<Stratum> strata;
    for (std::size_t n = 0; n < soils.size(); ++n) {
      const double bottom_m =
          n < bottoms_m.size() ? bottoms_m[n] : std::numeric_limits<double>::infinity();
      strata.push_back({bottom_m, static_cast<std::uint8_t>(n), 0, soils[n].bank_density_kgpm3});
    }
    plan.profiles.emplace_back(strata);
    return plan;
  }
  void Wait(double time_s) {
    for (int k = 0; k < std::lround(time_s / kStep_s); ++k) {
      grains.Step(kStep_s, &ground);
      avalanche.Flow(kStep_s, &ground, &grains);
    }
  }
  double EdgeTop_m() { return ground.at(ground.Touch(60, 60)).top_m; }
  /// Without the loose soil on it.
  double EdgeBank_m() { return EdgeTop_m() - ground.at(ground.Touch(60, 60)).loose_m(); }

  Columns ground;
  Avalanche avalanche;
  Grains grains;
  SpoilMix cut;
};

TEST(StandingWall, ClayUnderACrustStandsToTerzaghisHeightUnderASurcharge) {
  // A crust that cracks is a load q: 4 c / (rho g) tan(45 + phi / 2) - 2 q / (rho g).
  const SoilType crust = Shipped("hard_loam"), clay = Shipped("clay");
  for (const double crust_m : {0.1, 0.25}) {
    SCOPED_TRACE(crust_m);
    const double stands_m = kClayStands_m - 2 * crust_m * crust.bank_density_kgpm3 / 1790;
    LayeredWall stands({crust, clay}, {crust_m}, crust_m + 0.98 * stands_m);
    stands.Wait(1);
    EXPECT_EQ(stands.EdgeTop_m(), 0);
    LayeredWall fails({crust, clay}, {crust_m}, crust_m + 1.02 * stands_m);
    fails.Wait(1);
    EXPECT_LT(fails.EdgeBank_m(), -0.5 * stands_m);
  }
}

// By the length of the surface in each soil, from its height and slope there; the lowest is first.
TEST(LayeredBanks, RubAsTheSoilsDoThroughWhichTheSurfaceGoes) {
  const SoilType dirt = Shipped("dirt"), clay = Shipped("clay");
  const LayeredBanks banks({dirt, clay});
  const std::array<BankLayer, 2> layers = {{{0.6, 0}, {0.9, 1}}};
  const SlipSurface slip = banks.LeastSafe(layers, 0, 0);
  double length_m = 0, rubs_m = 0;
  for (int n = 0; n < slip.count; ++n) {
    const double tan_slope = slip.part[n].tan_slope;
    const double part_m = slip.part[n].height_m * std::sqrt(1 + 1 / (tan_slope * tan_slope));
    length_m += part_m;
    rubs_m += part_m * std::tan((n == 0 ? clay : dirt).friction_angle_rad);
  }
  ASSERT_GE(slip.count, 1);
  EXPECT_NEAR(slip.tan_friction, rubs_m / length_m, 1e-12);
  EXPECT_LT(slip.tan_friction, std::tan(dirt.friction_angle_rad) - 0.05);
}

// Clods that nothing speeds up down the surface are not held in the air by it.
TEST(StandingWall, OfDirtOverClayComesToRest) {
  LayeredWall wall({Shipped("dirt"), Shipped("clay")}, {0.3}, 2.2);
  wall.Wait(8);
  EXPECT_LT(wall.EdgeTop_m(), -0.3);
  EXPECT_EQ(wall.grains.count(), 0u);
}

TEST(StandingWall, ACrustOverSandFallsWithIt) {
  LayeredWall wall({Shipped("hard_loam"), Shipped("sand")}, {0.2}, 0.8);
  wall.Wait(6);
  EXPECT_LT(wall.EdgeTop_m(), -0.3);
  // As far as the sand's slope reaches, and no farther.
  EXPECT_EQ(wall.ground.TopAt(60 - 20, 60), 0);
  EXPECT_EQ(wall.grains.count(), 0u);
}

TEST(StandingWall, ClayOnFirmSoilStandsAsHighAsByItself) {
  const SoilType clay = Shipped("clay"), firm = Shipped("hard_loam");
  LayeredWall stands({clay, firm}, {0.98 * kClayStands_m}, 1.8);
  stands.Wait(1);
  EXPECT_EQ(stands.EdgeTop_m(), 0);
  LayeredWall fails({clay, firm}, {1.02 * kClayStands_m}, 1.8);
  fails.Wait(3);
  EXPECT_NEAR(fails.EdgeBank_m(), -1.02 * kClayStands_m, 0.06);
}

TEST(StandingWall, SandOverClaySlumpsAndTheClayBelowStands) {
  LayeredWall wall({Shipped("sand"), Shipped("clay")}, {0.3}, 1.0);
  wall.Wait(6);
  EXPECT_NEAR(wall.EdgeTop_m(), -0.3, 0.05);
  EXPECT_GE(wall.EdgeTop_m(), -0.3 - 1e-9);
  EXPECT_EQ(wall.ground.TopAt(40, 60), 0);
}

/// Height of the crust a quarter of a metre behind the rim of a pit in clay after two seconds. The
/// pit is 0.9 m deep with upright walls. The middle of a block on tracks stands `behind_m` behind
/// the rim.
double CrustUnderTracks_m(double behind_m, bool loaded = true) {
  // It stands up to 4 c / (rho g) tan(45 deg + phi / 2) - 2 q / (rho g): 1.19 m less 4.7 m under
  // half of the tracks' ground, 82 kPa.
  Block block(
      "size_m: [12, 6]\nsoil: clay\n"
      "pits: [{outline_m: [[0.01, -2], [3, -2], [3, 2], [0.01, 2]], depth_m: 0.9}]\n",
      Vec2(-behind_m, 0));
  if (!loaded) block.links[0].X_WB.translation().z() = 5;
  for (int k = 0; k < 1000; ++k) {
    if (loaded) {
      block.ActAndSinkGently();
    } else {
      block.Act();
    }
  }
  EXPECT_NEAR(block.soil->ledger().total_kg(), 0, 1e-9);
  return block.soil->surface().HeightAt(-0.25, 0.5 * kGauge_m);
}

TEST(StandingWall, AMachineOnTheRimOfABankBringsDownWhatStandsWithoutIt) {
  EXPECT_NEAR(CrustUnderTracks_m(0, false), 0, 1e-6);
  EXPECT_LT(CrustUnderTracks_m(0), -0.2);
  // Culmann's wedge is 0.9 m / tan 51.5 deg = 0.72 m wide. Tracks whose front end stands 1.2 m
  // behind the rim load none of it.
  EXPECT_NEAR(CrustUnderTracks_m(1.2 + 0.5 * kLength_m), 0, 0.02);
}

TEST(StandingWall, AHeapAtReposeUnderAMachineIsNoBank) {
  // A mound of loam, 1 m high, at repose: a track sinks into its summit, and nothing slides off as
  // a wedge.
  Block block("size_m: [12, 6]\nsoil: dirt\npiles: [{xy_m: [0, 0.6], height_m: 1, soil: dirt}]\n",
              Vec2(0, 0));
  block.links[0].X_WB.translation().z() = 1;
  for (int k = 0; k < 1000; ++k) {
    block.ActAndSinkGently();
    ASSERT_EQ(block.soil->ledger().grains_kg, 0) << k;
  }
}

}  // namespace
}  // namespace tera
