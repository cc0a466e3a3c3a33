#include "soil/site/seepage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "soil/block_fixture.h"
#include "soil/columns/soil_water.h"
#include "soil/site/site_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

constexpr double kBottom_m = std::numeric_limits<double>::infinity();

/// Ground of one shipped soil, and the weather that it has had.
struct WeatheredGround {
  std::vector<SoilType> soils;
  GroundProfile profile;
  WaterBalance balance;

  explicit WeatheredGround(const std::string& name, double moisture = -1)
      : soils({Shipped(name)}),
        profile({{kBottom_m, 0, static_cast<float>(moisture < 0 ? soils[0].moisture : moisture),
                  soils[0].bank_density_kgpm3}}) {}
  WaterBalance Have(double hours, double rain_mmph, double evaporation_mmpd) {
    balance = Seep({{hours, rain_mmph, evaporation_mmpd}}, soils, &profile);
    return balance;
  }
  /// Water over volume, to that depth.
  double Water(double depth_m) const {
    const double pores = Porosity(soils[0].bank_density_kgpm3, soils[0].moisture);
    double sum_m = 0, top_m = 0;
    for (const Stratum& stratum : profile.strata()) {
      const double low_m = std::min(depth_m, stratum.bottom_m);
      sum_m += pores * std::max(0.0, low_m - top_m) * static_cast<double>(stratum.moisture);
      top_m = stratum.bottom_m;
    }
    return sum_m / depth_m;
  }
};

TEST(Seepage, NoWaterIsLostOrMade) {
  GroundProfile profile(
      {{0.03, 0, 0.25f, 1474}, {0.5, 1, 0.1f, 1700}, {kBottom_m, 2, 0.95f, 1790}});
  const std::vector<SoilType> soils = {Shipped("dirt"), Shipped("sand"), Shipped("clay")};
  const double before_kgpm2 = profile.Mass_kgpm2(0, 3);
  const WaterBalance w = Seep({{5, 80, 0}, {20, 0, 6}, {1, 200, 0}, {3, 4, 2}}, soils, &profile);
  EXPECT_NEAR(w.rained_m, 0.4 + 0.2 + 0.012, 1e-12);
  EXPECT_NEAR(w.rained_m - w.ran_off_m - w.evaporated_m - w.drained_m - w.stored_m, 0, 1e-12);
  EXPECT_GT(w.ran_off_m, 0);
  EXPECT_GT(w.evaporated_m, 0);
  EXPECT_NEAR(profile.Mass_kgpm2(0, 3) - before_kgpm2, 1000 * w.stored_m, 1e-3);  // in floats
  for (const Stratum& stratum : profile.strata()) {
    EXPECT_GE(stratum.moisture, 0);
    EXPECT_LE(stratum.moisture, 1);
  }
}

// Once the ground is saturated for the rain, steady rain leaves below at its own rate. Rain beyond
// the saturated conductivity (of loam 24.96 cm a day, Carsel and Parrish 1988) runs off.
TEST(Seepage, SteadyRainDrainsAndTheRestRunsOff) {
  WeatheredGround loam("dirt");
  loam.Have(200, 10, 0);
  EXPECT_NEAR(loam.Have(10, 10, 0).drained_m, 0.1, 1e-3);
  EXPECT_NEAR(loam.balance.ran_off_m, 0, 1e-9);
  WeatheredGround tight("hard_loam");
  tight.Have(200, 100, 0);
  EXPECT_NEAR(tight.Have(10, 100, 0).ran_off_m, 1 - 10 * 0.2496 / 24, 2e-3);
}

// Two days after saturation, soil holds its field capacity. By volume it is 0.207 for sandy loam
// and 0.091 for sand (Rawls, Brakensiek and Saxton 1982, at 33 kPa).
TEST(Seepage, SaturatedSoilDrainsToFieldCapacity) {
  WeatheredGround loam("dirt", 1), sand("sand", 1);
  loam.Have(48, 0, 0);
  sand.Have(48, 0, 0);
  EXPECT_NEAR(loam.Water(0.3), 0.207, 0.06);
  EXPECT_NEAR(sand.Water(0.3), 0.091, 0.04);
  ::testing::Test::RecordProperty("loam", std::to_string(loam.Water(0.3)));
  ::testing::Test::RecordProperty("sand", std::to_string(sand.Water(0.3)));
}

TEST(Seepage, WetGroundEvaporatesAtThePotentialRateAndDryGroundLess) {
  WeatheredGround ground("clay");
  EXPECT_NEAR(ground.Have(24, 0, 5).evaporated_m, 0.005, 1e-9);
  WeatheredGround dry("dirt");
  const double first_m = dry.Have(240, 0, 5).evaporated_m,
               later_m = dry.Have(240, 0, 5).evaporated_m;
  EXPECT_LT(first_m, 0.05);
  EXPECT_LT(later_m, 0.5 * first_m);
}

// Lean clay at 22 and at 32 % of water (Wong 2008, table 2.3): c 68.95 and 13.79 kPa, k_phi 1724.69
// and 119.61. Its pores are full at 24.4 %: by even steps of the logarithms 0.675 of its cohesion
// and 0.52 of its modulus are left.
TEST(SoilWater, LeanClayLosesWithWaterWhatWongsRowsLose) {
  const SoilType moist = Shipped("stiff_clay"), full = AtMoisture(moist, 1);
  EXPECT_NEAR(full.shear_cohesion_pa / moist.shear_cohesion_pa / 0.675, 1, 0.25);
  EXPECT_NEAR(full.k_phi_npm_n2 / moist.k_phi_npm_n2 / 0.52, 1, 0.25);
}

// Menisci hold moist sand together with about 1 kPa (Lu, Wu and Tan 2007, J. Geotech. Geoenviron.
// Eng. 133: tensile strengths of sands up to 1.5 kPa), but neither dry nor flooded sand.
TEST(SoilWater, OnlyMoistSandIsHeldTogether) {
  const SoilType sand = Shipped("sand");
  for (const double moisture : {0.2, 0.5, 0.8}) {
    EXPECT_GT(AtMoisture(sand, moisture).cohesion_pa, 150) << moisture;
    EXPECT_LT(AtMoisture(sand, moisture).cohesion_pa, 1500) << moisture;
  }
  EXPECT_EQ(AtMoisture(sand, 0.02).cohesion_pa, 0);
  EXPECT_EQ(AtMoisture(sand, 1).cohesion_pa, 0);
}

TEST(SoilWater, WaterAddsItsOwnWeight) {
  const SoilType dirt = Shipped("dirt"), wet = AtMoisture(dirt, 0.75);
  // Grains of 2650 kg/m^3 and a quarter of the pores in 1474 kg/m^3: (2650 - 1474) / (2650 - 250).
  EXPECT_NEAR(wet.bank_density_kgpm3 - dirt.bank_density_kgpm3, 500 * 1176 / 2400.0, 1e-9);
  EXPECT_GE(wet.max_density_kgpm3, wet.bank_density_kgpm3);
  EXPECT_EQ(wet.swell, dirt.swell);
}

TEST(WeatherBefore, WetsGroundAndPilesAndShows) {
  const std::string site =
      "size_m: [10, 10]\nsoil: dirt\npiles: [{xy_m: [3, 0], height_m: 0.8, soil: sand}]\n";
  const auto dry = MakeGround(site);
  const auto wet = MakeGround(site + "weather_before: [{hours: 10, rain_mmph: 8}, {hours: 1}]\n");
  for (const double x_m : {-2.0, 3.0}) {
    const int i = static_cast<int>(std::lround((x_m + 5) / 0.05));
    EXPECT_GT(wet->surface().at(i, 100).cover.moisture, dry->surface().at(i, 100).cover.moisture);
    EXPECT_GT(wet->SampleBelow(x_m, 0, 0.05)->moisture, dry->SampleBelow(x_m, 0, 0.05)->moisture);
    EXPECT_GT(wet->SampleBelow(x_m, 0, 0.05)->density_kgpm3,
              dry->SampleBelow(x_m, 0, 0.05)->density_kgpm3);
  }
  EXPECT_NEAR(wet->SampleBelow(-2, 0, 1.9)->moisture, dry->SampleBelow(-2, 0, 1.9)->moisture, 1e-4);
  EXPECT_NEAR(wet->SampleBelow(-2, 0, 0.05)->compaction, 1, 0.01);
}

// Loam whose pores are full cannot drain while a track passes.
TEST(WeatherBefore, TracksSinkInMud) {
  const std::string site = "size_m: [8, 6]\nsoil: dirt\n";
  Block dry(site, Vec2(0, 0)),
      mud(site + "weather_before: [{hours: 30, rain_mmph: 60}]\n", Vec2(0, 0)),
      drained(site + "weather_before: [{hours: 30, rain_mmph: 60}, {hours: 24}]\n", Vec2(0, 0));
  for (auto& [name, block] : {std::pair("moist_mm", &dry), std::pair("mud_mm", &mud),
                              std::pair("a_day_later_mm", &drained)}) {
    block->Stand();
    RecordProperty(name, std::to_string(-1000 * block->links[0].X_WB.translation().z()));
  }
  EXPECT_GT(drained.links[0].X_WB.translation().z(), 2 * dry.links[0].X_WB.translation().z());
  EXPECT_GT(mud.links[0].X_WB.translation().z(), -1);
  EXPECT_LT(mud.links[0].X_WB.translation().z(), 3 * dry.links[0].X_WB.translation().z());
  EXPECT_NEAR(mud.soil->ledger().total_kg(), 0, 1e-9);
}

TEST(WeatherBefore, FaultsAreNamed) {
  EXPECT_THAT(FaultsOf("weather_before: [{rain_mmph: 3}]\n"),
              HasFault(FaultKind::kMissing, "weather_before[0].hours"));
  EXPECT_THAT(FaultsOf("weather_before: [{hours: 3, rain_mmph: -1}]\n"),
              HasFault(FaultKind::kOutOfRange, "weather_before[0].rain_mmph"));
  EXPECT_THAT(FaultsOf("weather_before: [{hours: 0}]\n"),
              HasFault(FaultKind::kOutOfRange, "weather_before[0].hours"));
  EXPECT_THAT(FaultsOf("layers: [{soil: dirt, from_m: 0, moisture: 1.2}]\n"),
              HasFault(FaultKind::kOutOfRange, "layers[0].moisture"));
}

}  // namespace
}  // namespace tera
