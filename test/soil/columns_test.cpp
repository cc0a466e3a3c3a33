#include "soil/columns.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "soil/soil_type.h"
#include "soil_fixture.h"

namespace tera {
namespace {

SoilType Dirt() {
  const Config config = Config::FromFile(*ShippedSoilFile("dirt"));
  return ReadSoilType(config.root());
}

/// 6 m x 6 m of dirt, one metre above zero, cells of 5 cm.
Columns SmallSite() {
  constexpr int kN = 121;
  return Columns(Vec2(-3, -3), 0.05, kN, kN, std::vector<double>(kN * kN, 1.0),
                 std::vector<std::uint8_t>(kN * kN, 0), {Dirt()});
}

TEST(Columns, CutSoilSwellsAndWeighsWhatItsBankWeighed) {
  Columns ground = SmallSite();
  const double before_kg = ground.GroundMass_kg();
  const Spoil cut = ground.Cut(ground.index(60, 60), 0.8);
  const double bank_m3 = 0.2 * 0.05 * 0.05;
  EXPECT_NEAR(cut.mass_kg, bank_m3 * 1474, 1e-9);
  EXPECT_NEAR(cut.volume_m3, bank_m3 * 1.1, 1e-12);
  EXPECT_NEAR(ground.GroundMass_kg() + cut.mass_kg, before_kg, 1e-9 * before_kg);
  EXPECT_FLOAT_EQ(ground.surface().height_m[ground.index(60, 60)], 0.8f);
}

TEST(Columns, DepositRaisesTheGroundByItsVolume) {
  Columns ground = SmallSite();
  ground.Deposit(ground.index(10, 20), {3.35, 0.0025, 0});
  EXPECT_NEAR(ground.at(ground.index(10, 20)).top_m(), 2.0, 1e-12);
  EXPECT_EQ(ground.surface().looseness[ground.index(10, 20)], 255);
}

TEST(Columns, PressingTurnsVolumeIntoDensity) {
  Columns ground = SmallSite();
  const double before_kg = ground.GroundMass_kg();
  const std::size_t k = ground.index(5, 5);
  const Spoil beside = ground.Press(k, 0.05, 0.3);
  EXPECT_EQ(beside.mass_kg, 0);  // 1474 * 0.30 / 0.25 = 1769 is below 2000 kg/m^3
  EXPECT_NEAR(ground.at(k).top_m(), 0.95, 1e-12);
  EXPECT_NEAR(ground.at(k).crust_kgpm2 / ground.at(k).crust_m, 1474 * 0.30 / 0.25, 1e-6);
  EXPECT_NEAR(ground.GroundMass_kg() / before_kg, 1, 1e-12);
}

TEST(Columns, WhatExceedsTheGreatestDensityGoesBeside) {
  Columns ground = SmallSite();
  const double before_kg = ground.GroundMass_kg();
  const Spoil beside = ground.Press(ground.index(5, 5), 0.15, 0.3);
  // 0.15 m of crust can hold 0.15 * 2000 of the 0.3 * 1474 kg/m^2.
  EXPECT_NEAR(beside.mass_kg, (0.3 * 1474 - 0.15 * 2000) * 0.0025, 1e-9);
  EXPECT_NEAR((ground.GroundMass_kg() + beside.mass_kg) / before_kg, 1, 1e-12);
}

TEST(Columns, CuttingThroughCrustGivesItsMassBack) {
  Columns ground = SmallSite();
  const std::size_t k = ground.index(50, 7);
  ground.Press(k, 0.05, 0.3);
  const Spoil cut = ground.Cut(k, 0.6);
  EXPECT_NEAR(cut.mass_kg, 0.4 * 1474 * 0.0025, 1e-9);  // what stood there from 0.6 to 1.0
}

TEST(Columns, SoilBeyondTheBorderIsOutside) {
  Columns ground = SmallSite();
  ground.DepositAt(-1, 5, {2.5, 0.002, 0});
  EXPECT_EQ(ground.outside_kg(), 2.5);
}

TEST(Columns, OnlyTilesOfChangedVerticesGetANewVersion) {
  Columns ground = SmallSite();  // 120 squares: 3 x 3 tiles
  std::vector<std::uint32_t> before = ground.surface().tile_version;
  ground.Cut(ground.index(70, 30), 0.9);
  std::vector<std::uint32_t> after = ground.surface().tile_version;
  for (int tile = 0; tile < 9; ++tile) EXPECT_EQ(after[tile] != before[tile], tile == 1) << tile;
  before = after;
  ground.Cut(ground.index(50, 100), 0.9);  // on the corner of four tiles
  after = ground.surface().tile_version;
  for (int tile = 0; tile < 9; ++tile) {
    const bool touches = tile == 3 || tile == 4 || tile == 6 || tile == 7;
    EXPECT_EQ(after[tile] != before[tile], touches) << tile;
  }
}

}  // namespace
}  // namespace tera
