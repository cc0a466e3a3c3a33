#include "soil/columns/column.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr double kArea_m2 = 0.0025;

/// Topsoil, 0.3 m of 1300 kg/m^3, over clay of 1800, swells 1.25 and 1.4.
class ColumnTest : public ::testing::Test {
 protected:
  ColumnTest() {
    soils_[0].bank_density_kgpm3 = 1300;
    soils_[0].max_density_kgpm3 = 1600;
    soils_[0].swell = 1.25;
    soils_[1].bank_density_kgpm3 = 1800;
    soils_[1].max_density_kgpm3 = 1900;
    soils_[1].swell = 1.4;
    column_.ground_m = column_.bank_m = column_.top_m = 2.0;
  }
  SpoilMix Cut(double z_m) {
    SpoilMix cut;
    CutColumn(material_, z_m, &column_, &cut);
    return cut;
  }
  void Deposit(double thickness_m, double density_kgpm3, std::uint8_t soil) {
    DepositOn(material_,
              {thickness_m * density_kgpm3 * kArea_m2, thickness_m * kArea_m2, soil, 0.5f},
              &column_);
  }
  double Gain_kgpm2() const { return column_.Gain_kgpm2(profile_); }

  std::vector<SoilType> soils_{2};
  GroundProfile profile_{
      {{0.3, 0, 0.2f, 1300}, {std::numeric_limits<double>::infinity(), 1, 0.6f, 1800}}};
  ColumnMaterial material_{profile_, soils_, kArea_m2};
  Column column_;
};

TEST_F(ColumnTest, ATrenchThroughTopsoilGivesWhatLayUnderIt) {
  const SpoilMix cut = Cut(1.5);
  ASSERT_EQ(cut.parts().size(), 2u);
  EXPECT_NEAR(cut.parts()[0].mass_kg, 0.3 * 1300 * kArea_m2, 1e-12);
  EXPECT_NEAR(cut.parts()[0].volume_m3, 0.3 * 1.25 * kArea_m2, 1e-12);
  EXPECT_NEAR(cut.parts()[1].mass_kg, 0.2 * 1800 * kArea_m2, 1e-12);
  EXPECT_NEAR(cut.parts()[1].volume_m3, 0.2 * 1.4 * kArea_m2, 1e-12);
  EXPECT_FLOAT_EQ(cut.parts()[1].moisture, 0.6f);
  EXPECT_NEAR(Gain_kgpm2(), -(0.3 * 1300 + 0.2 * 1800), 1e-9);
  EXPECT_EQ(column_.top_m, 1.5);
  EXPECT_EQ(profile_.Below(column_.ground_m - column_.bank_m).soil, 1);
}

TEST_F(ColumnTest, WhatIsPressedStaysOfItsStratum) {
  SpoilMix beside;
  PressColumn(material_, {.ds_m = 0.02, .influence_m = 0.5, .pressure_pa = 1e9}, &column_, &beside);
  ASSERT_EQ(column_.layer_count, 2);
  EXPECT_EQ(column_.layers[1].soil, 0);
  EXPECT_EQ(column_.layers[0].soil, 1);
  EXPECT_NEAR(column_.layers[1].kgpm2, 0.3 * 1300, 1e-9);
  EXPECT_NEAR(column_.layers[0].kgpm2, 0.2 * 1800, 1e-9);
  EXPECT_FLOAT_EQ(column_.layers[0].moisture, 0.6f);
  EXPECT_NEAR(column_.top_m, 1.98, 1e-12);
  EXPECT_NEAR(Gain_kgpm2(), 0, 1e-9);
  EXPECT_EQ(beside.mass_kg(), 0);
}

TEST_F(ColumnTest, WhatIsPutOnLastIsTakenFirst) {
  Deposit(0.10, 1000, 1);
  Deposit(0.05, 900, 0);
  Deposit(0.05, 1100, 0);  // joins the layer of its kind
  EXPECT_EQ(column_.layer_count, 2);
  EXPECT_NEAR(column_.top_m, 2.2, 1e-12);
  const SpoilMix cut = Cut(2.05);
  ASSERT_EQ(cut.parts().size(), 2u);
  EXPECT_NEAR(cut.parts()[0].mass_kg, 0.1 * 1000 * kArea_m2, 1e-12);
  EXPECT_NEAR(cut.parts()[1].mass_kg, 0.05 * 1000 * kArea_m2, 1e-12);
  EXPECT_NEAR(cut.parts()[1].volume_m3, 0.05 * kArea_m2, 1e-15);  // loose soil does not swell again
  EXPECT_NEAR(Gain_kgpm2(), 0.05 * 1000, 1e-9);
}

TEST_F(ColumnTest, DustThatIsTooThinToMeasureIsCutWithItsMass) {
  // Parts of parts leave, by rounding, mass without volume.
  const double dust_kg = 1e-18;
  DepositOn(material_, {dust_kg, 0, 0, 0.5f}, &column_);
  Deposit(0.10, 1000, 1);
  const SpoilMix cut = Cut(1.9);
  ASSERT_EQ(cut.parts().size(), 2u);
  EXPECT_NEAR(cut.parts()[0].volume_m3, 0.1 * 1.25 * kArea_m2, 1e-12);
  EXPECT_NEAR(cut.parts()[0].mass_kg, 0.1 * 1300 * kArea_m2, 1e-12);
  EXPECT_NEAR(cut.parts()[1].mass_kg, 0.1 * 1000 * kArea_m2, 1e-12);
  EXPECT_NEAR(Gain_kgpm2(), -0.1 * 1300, 1e-9);
}

TEST_F(ColumnTest, AFullColumnJoinsLayersAndKeepsTheirMassAndHeight) {
  double mass_kgpm2 = 0;
  for (int n = 0; n < 12; ++n) {
    const double thickness_m = 0.01 * (1 + n % 4), density_kgpm3 = 1000 + 10 * n;
    Deposit(thickness_m, density_kgpm3, static_cast<std::uint8_t>(n % 2));
    mass_kgpm2 += thickness_m * density_kgpm3;
  }
  EXPECT_LE(column_.layer_count, Column::kMostLayers);
  EXPECT_NEAR(Gain_kgpm2(), mass_kgpm2, 1e-9);
  EXPECT_NEAR(column_.top_m, 2 + 0.01 * 3 * (1 + 2 + 3 + 4), 1e-12);
  EXPECT_NEAR(Cut(2.0).mass_kg(), mass_kgpm2 * kArea_m2, 1e-9);
}

TEST_F(ColumnTest, LooseSoilGivesWayBeforeTheBankBelow) {
  Deposit(0.2, 1300 / 1.25, 0);
  SpoilMix beside;
  PressColumn(material_, {0.03, 0.3}, &column_, &beside);
  EXPECT_TRUE(column_.top_layer()->loose);
  EXPECT_NEAR(column_.top_layer()->density_kgpm3(), 0.2 * 1040 / 0.17, 1e-9);
  EXPECT_EQ(column_.bank_m, 2.0);
  // At 0.16 m it is as dense as bank soil and stands; 5 cm more compact the upper 0.3 m to 0.25.
  PressColumn(material_, {0.06, 0.3}, &column_, &beside);
  EXPECT_FALSE(column_.top_layer()->loose);
  EXPECT_NEAR(column_.top_m, 2.2 - 0.09, 1e-12);
  EXPECT_NEAR(column_.top_layer()->density_kgpm3(), 1300 * 0.3 / 0.25, 1e-6);
  EXPECT_TRUE(beside.empty());
  EXPECT_NEAR(Gain_kgpm2(), 0.2 * 1040, 1e-9);
}

TEST_F(ColumnTest, WhatThePressureDoesNotPressTogetherIsShovedAside) {
  // Grains of 2650 kg/m^3: a void ratio of 1.0385 loses 0.2 for the tenfold of 10 kPa, 1441.4
  // kg/m^3. The upper 0.3 m become 0.24 m of that.
  soils_[0].compression_index = 0.2;
  SpoilMix beside;
  PressColumn(material_, {0.06, 0.3, 90e3}, &column_, &beside);
  EXPECT_NEAR(column_.top_layer()->density_kgpm3(), 1441.4, 0.1);
  EXPECT_NEAR(beside.mass_kg(), (0.3 * 1300 - 0.24 * 1441.4) * kArea_m2, 1e-3);
  EXPECT_NEAR(Gain_kgpm2() * kArea_m2 + beside.mass_kg(), 0, 1e-9);
}

TEST_F(ColumnTest, DumpedSoilIsAsFirmAsItsDensityOverADepthOfThreeTenths) {
  // Terzaghi's 12.4th power of the mean density there over the undisturbed one.
  EXPECT_EQ(FirmnessOf(column_, soils_), 1);
  Deposit(0.15, 1040, 0);
  EXPECT_NEAR(FirmnessOf(column_, soils_), std::pow(0.5 * (0.8 + 1), 12.4), 1e-9);
  Deposit(0.35, 1040, 0);
  EXPECT_NEAR(FirmnessOf(column_, soils_), std::pow(0.8, 12.4), 1e-9);
}

TEST_F(ColumnTest, PressedDeeperThanItsLayersItKeepsEveryKilogram) {
  SpoilMix beside;
  PressColumn(material_, {0.8, 0.3}, &column_, &beside);
  EXPECT_NEAR(column_.top_m, 1.2, 1e-9);
  EXPECT_NEAR(Gain_kgpm2() * kArea_m2 + beside.mass_kg(), 0, 1e-9);
  EXPECT_LE(column_.top_layer()->density_kgpm3(), 1900 + 1e-6);
}

TEST_F(ColumnTest, CuttingNothingTakesNothing) {
  EXPECT_TRUE(Cut(2.0).empty());
  EXPECT_TRUE(Cut(3.0).empty());
  EXPECT_EQ(Gain_kgpm2(), 0);
}

}  // namespace
}  // namespace tera
