#include "soil/columns/columns.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "soil/columns/soil_type.h"
#include "soil/soil_fixture.h"

namespace tera {
namespace {

using testing_soil::LevelColumns;

SoilType Dirt() { return testing_soil::Shipped("dirt"); }

/// 6 m x 6 m of dirt, one metre above zero, cells of 5 cm.
Columns SmallSite() { return LevelColumns(Dirt(), 0.05, 121, 1.0); }

Spoil CutOne(Columns* ground, ColumnId k, double z_m) {
  SpoilMix cut;
  ground->Cut(k, z_m, &cut);
  return cut.parts().at(0);
}

TEST(Columns, CutSoilSwellsAndWeighsWhatItsBankWeighed) {
  Columns ground = SmallSite();
  const Spoil cut = CutOne(&ground, ground.Touch(60, 60), 0.8);
  const double bank_m3 = 0.2 * 0.05 * 0.05;
  EXPECT_NEAR(cut.mass_kg, bank_m3 * 1474, 1e-12);
  EXPECT_NEAR(cut.volume_m3, bank_m3 * 1.1, 1e-15);
  EXPECT_NEAR(ground.GroundGain().net_kg, -cut.mass_kg, 1e-12);
  EXPECT_FLOAT_EQ(ground.surface().height_m(60, 60), 0.8f);
}

TEST(Columns, DepositRaisesTheGroundByItsVolume) {
  Columns ground = SmallSite();
  ground.Deposit(ground.Touch(10, 20), Spoil{3.35, 0.0025, 0, 0});
  EXPECT_NEAR(ground.TopAt(10, 20), 2.0, 1e-12);
  EXPECT_EQ(ground.surface().at(10, 20).cover.looseness, 255);
}

TEST(Columns, PressingTurnsVolumeIntoDensity) {
  Columns ground = SmallSite();
  const ColumnId k = ground.Touch(5, 5);
  SpoilMix beside;
  ground.Press(k, {0.05, 0.3}, &beside);
  EXPECT_TRUE(beside.empty());  // 1474 * 0.30 / 0.25 = 1769 is below 2000 kg/m^3
  EXPECT_NEAR(ground.at(k).top_m, 0.95, 1e-12);
  EXPECT_NEAR(ground.at(k).top_layer()->density_kgpm3(), 1474 * 0.30 / 0.25, 1e-6);
  EXPECT_NEAR(ground.GroundGain().net_kg, 0, 1e-12);
}

TEST(Columns, WhatExceedsTheGreatestDensityGoesBeside) {
  Columns ground = SmallSite();
  SpoilMix beside;
  ground.Press(ground.Touch(5, 5), {0.15, 0.3}, &beside);
  // 0.15 m of crust can hold 0.15 * 2000 of the 0.3 * 1474 kg/m^2.
  EXPECT_NEAR(beside.mass_kg(), (0.3 * 1474 - 0.15 * 2000) * 0.0025, 1e-9);
  EXPECT_NEAR(ground.GroundGain().net_kg, -beside.mass_kg(), 1e-12);
}

TEST(Columns, CuttingThroughCrustGivesItsMassBack) {
  Columns ground = SmallSite();
  const ColumnId k = ground.Touch(50, 7);
  SpoilMix beside;
  ground.Press(k, {0.05, 0.3}, &beside);
  EXPECT_NEAR(CutOne(&ground, k, 0.6).mass_kg, 0.4 * 1474 * 0.0025, 1e-9);
}

TEST(Columns, SoilBeyondTheBorderIsOutside) {
  Columns ground = SmallSite();
  SpoilMix spoil;
  spoil.Add({2.5, 0.002, 0, 0});
  ground.DepositAt(-1, 5, spoil);
  EXPECT_EQ(ground.outside_kg(), 2.5);
}

TEST(Columns, OnlyTilesOfChangedVerticesGetANewVersion) {
  Columns ground = SmallSite();  // 120 squares: 3 x 3 tiles
  const auto versions = [&] {
    std::vector<std::uint32_t> all;
    for (int tile = 0; tile < 9; ++tile) {
      all.push_back(ground.surface().tile_version(tile % 3, tile / 3));
    }
    return all;
  };
  std::vector<std::uint32_t> before = versions();
  CutOne(&ground, ground.Touch(70, 30), 0.9);
  std::vector<std::uint32_t> after = versions();
  for (int tile = 0; tile < 9; ++tile) EXPECT_EQ(after[tile] != before[tile], tile == 1) << tile;
  before = after;
  CutOne(&ground, ground.Touch(50, 100), 0.9);  // on the corner of four tiles
  after = versions();
  for (int tile = 0; tile < 9; ++tile) {
    const bool touches = tile == 3 || tile == 4 || tile == 6 || tile == 7;
    EXPECT_EQ(after[tile] != before[tile], touches) << tile;
  }
}

TEST(Columns, TouchingGroundChangesNeitherItNorItsLooks) {
  Columns ground = SmallSite();
  const double before_m = ground.HeightAt(0.31, -0.22);
  const std::uint32_t version = ground.surface().tile_version(1, 1);
  ground.Touch(60, 60);
  EXPECT_EQ(ground.HeightAt(0.31, -0.22), before_m);
  EXPECT_EQ(ground.surface().tile_version(1, 1), version);
  EXPECT_EQ(ground.GroundGain().gained_kg, 0);
}

TEST(Columns, WhatIsWellAboveIsAboveTheGroundAndAboveAllThatItWas) {
  Columns ground = LevelColumns(Dirt(), 0.05, 121);
  EXPECT_FALSE(ground.IsWellAbove(Vec3(0.01, 0.02, 1)));  // nothing is known of this tile
  const ColumnId k = ground.Touch(60, 60);
  EXPECT_TRUE(ground.IsWellAbove(Vec3(0.01, 0.02, 1e-6)));
  EXPECT_FALSE(ground.IsWellAbove(Vec3(0.01, 0.02, 0)));
  ground.Deposit(k, Spoil{1, 0.3 * ground.area_m2()});
  EXPECT_FALSE(ground.IsWellAbove(Vec3(1.0, 0.02, 0.29)));
  EXPECT_TRUE(ground.IsWellAbove(Vec3(1.0, 0.02, 0.31)));
  EXPECT_FALSE(ground.IsWellAbove(Vec3(1.99, 0.02, 0.31)));  // between two tiles
}

TEST(Columns, NormalsAreThoseOfTheSurfaceWithinTilesAndOverTheirBorders) {
  Columns ground = LevelColumns(Dirt(), 0.05, 121);  // three tiles to a side; the middle's is quiet
  const Stream random(3, "heights");
  std::uint64_t n = 0;
  for (int j = 0; j < 121; ++j) {
    for (int i = 0; i < 45; ++i) {
      const double volume_m3 = 0.04 * random.Uniform(++n) * ground.area_m2();
      ground.Deposit(ground.Touch(i, j), Spoil{1000 * volume_m3, volume_m3});
    }
  }
  for (int k = 0; k < 2000; ++k) {
    const Vec2 p(6.2 * random.Uniform(n + 1) - 3.1, 6.2 * random.Uniform(n + 2) - 3.1);
    n += 2;
    const auto z_m = [&](double dx, double dy) { return ground.HeightAt(p.x() + dx, p.y() + dy); };
    const Vec3 across_x(0.1, 0, z_m(0.05, 0) - z_m(-0.05, 0));
    const Vec3 across_y(0, 0.1, z_m(0, 0.05) - z_m(0, -0.05));
    const Vec3 normal = ground.NormalAt(p.x(), p.y());
    ASSERT_NEAR(normal.norm(), 1, 1e-12);
    ASSERT_GT(normal.z(), 0);
    ASSERT_NEAR(normal.dot(across_x), 0, 1e-12) << p.transpose();
    ASSERT_NEAR(normal.dot(across_y), 0, 1e-12) << p.transpose();
  }
}

TEST(Columns, EveryColumnIsFoundAgainAndHasItsNeighbours) {
  Columns ground = LevelColumns(Dirt(), 0.05, 121);
  for (const auto& [i, j] :
       {std::pair{0, 0}, {49, 49}, {50, 50}, {99, 100}, {120, 120}, {120, 3}}) {
    const ColumnId k = ground.Touch(i, j);
    EXPECT_EQ(ground.PlaceOf(k).i, i);
    EXPECT_EQ(ground.PlaceOf(k).j, j);
    for (const auto& [di, dj] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {1, -1}}) {
      const ColumnId expected =
          ground.Contains(i + di, j + dj) ? ground.Touch(i + di, j + dj) : Columns::kNone;
      EXPECT_EQ(ground.BesideId(k, di, dj), expected) << i << ' ' << j << ' ' << di << ' ' << dj;
    }
  }
}

}  // namespace
}  // namespace tera
