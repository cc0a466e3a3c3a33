#include "soil/site/ground_weather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "soil/block_fixture.h"
#include "soil/columns/soil_water.h"

namespace tera {
namespace {

using namespace testing_soil;

constexpr TimeNs kMinute_ns = 60'000'000'000;
constexpr TimeNs kHour_ns = 60 * kMinute_ns;
constexpr char kDirt[] = "size_m: [10, 10]\ncell_m: 0.1\nsoil: dirt\n";

/// A site under weather.
Site Under(const std::string& terrain_yaml, double rain_mmph, double evaporation_mmpd = 0,
           bool is_wet = false) {
  Site site = SiteOf(terrain_yaml);
  EXPECT_TRUE(site.LetWeatherAct({0, rain_mmph, evaporation_mmpd}, is_wet));
  return site;
}

/// Mass below a square metre of untouched ground, down to 2.5 m.
double Mass_kg(const Soil& soil) {
  const SoilVoxels cubes = soil.Voxels({Vec3(-4.5, -4.5, -2.5), Vec3(-3.5, -3.5, 0.5), 10});
  return std::accumulate(cubes.mass_kg.begin(), cubes.mass_kg.end(), 0.0);
}

// Dirt has room for 37 mm in its upper 0.1 m: 12 mm of an hour all soak in. Hard loam lets 10.4
// mm/h through when it is full (Carsel and Parrish 1988): most of 200 mm/h runs off.
TEST(GroundWeather, GroundGainsTheRainLessWhatRunsOff) {
  for (const auto& [name, rain_mmph] : {std::pair("dirt", 12.0), {"hard_loam", 200.0}}) {
    const Site site =
        Under("size_m: [10, 10]\ncell_m: 0.1\nsoil: " + std::string(name) + "\n", rain_mmph);
    const auto soil = MakeSoil(site, 1);
    const double before_kg = Mass_kg(*soil);
    for (TimeNs t_ns = 0; t_ns <= kHour_ns; t_ns += kMinute_ns / 7) soil->LetWeatherAct(t_ns);
    soil->LetWeatherAct(kHour_ns);
    Seepage seepage(site.soils(), site.columns().profiles()[0]);
    for (int period = 0; period < 360; ++period) seepage.Run({0, rain_mmph, 0}, 10);
    const WaterBalance& water = seepage.balance();
    EXPECT_NEAR(water.rained_m, 1e-3 * rain_mmph, 1e-12) << name;
    EXPECT_NEAR(water.rained_m - water.ran_off_m - water.drained_m - water.stored_m, 0, 1e-12);
    EXPECT_NEAR(Mass_kg(*soil) - before_kg, 1000 * water.stored_m, 1e-6) << name;
    EXPECT_EQ(water.ran_off_m > 0.05, rain_mmph > 100) << name;
  }
}

TEST(GroundWeather, WetGroundDrainsAndDries) {
  const Site site =
      Under(std::string(kDirt) + "weather_before: [{hours: 10, rain_mmph: 8}]\n", 0, 6);
  const auto soil = MakeSoil(site, 1);
  const double at_start = soil->SampleBelow(-4, -4, 0.05)->moisture;
  const double deep = soil->SampleBelow(-4, -4, 0.45)->moisture;
  soil->LetWeatherAct(12 * kHour_ns);
  EXPECT_LT(soil->SampleBelow(-4, -4, 0.05)->moisture, at_start - 0.05);
  EXPECT_GT(soil->SampleBelow(-4, -4, 0.45)->moisture, deep + 0.02);
  EXPECT_LT(soil->surface().at(20, 20).cover.moisture, site.surface().at(20, 20).cover.moisture);
}

// 10 mm/h bring 1/6 mm a minute, and 2 mm of dirt have pores of 2 mm (2650 - 1474) / 2400.
TEST(GroundWeather, ASurfaceDarkensAsItsUpperTwoMillimetresFill) {
  const Site site = Under(kDirt, 10);
  const auto soil = MakeSoil(site, 1);
  const auto seen = [&] { return soil->surface().at(20, 20).cover.moisture / 255.0; };
  EXPECT_NEAR(seen(), 0.25, 0.003);
  soil->LetWeatherAct(kMinute_ns);
  EXPECT_NEAR(seen(), 0.25 + 1.0 / 6 / (2 * 1176 / 2400.0), 0.003);
  EXPECT_EQ(soil->surface().at(20, 20).cover, soil->surface().at(70, 90).cover);
  soil->LetWeatherAct(15 * kMinute_ns);
  const SoilWater& water =
      site.soils()[0].water;  // full to the moisture that lets the rain through
  EXPECT_NEAR(Conductivity_mps(water, seen()), 0.01 / 3600, 0.05 * 0.01 / 3600);
  EXPECT_NEAR(Under(kDirt, 10, 0, true).surface().at(20, 20).cover.moisture / 255.0, seen(), 0.003);
}

TEST(GroundWeather, PavementAndDrySkiesChangeNothing) {
  const Site paved = Under("size_m: [10, 10]\ncell_m: 0.1\nsoil: asphalt\n", 30, 5, true);
  const auto soil = MakeSoil(paved, 1);
  const auto before = soil->surface().at(20, 20).cover;
  soil->LetWeatherAct(kHour_ns);
  EXPECT_EQ(soil->surface().at(20, 20).cover, before);
  EXPECT_EQ(soil->soils().size(), 1u);
  const Site dry = SiteOf(kDirt);
  EXPECT_FALSE(dry.weather());
  EXPECT_EQ(dry.columns().soils().size(), 1u);
}

// Soil that lies on the ground, thicker than the rain has come, gains as much water as the ground
// does. The ledger counts it.
TEST(GroundWeather, HeapsTakeUpAsMuchAndTheLedgerCloses) {
  const Site site =
      Under(std::string(kDirt) + "piles: [{xy_m: [2, 0], height_m: 0.8, soil: sand}]\n", 12);
  const auto soil = MakeSoil(site, 1);
  const SoilSample before = *soil->SampleBelow(2, 0, 0.05);
  const auto heap_kgpm2 = [&] {
    const SoilVoxels cubes = soil->Voxels({Vec3(1.9, -0.1, 0), Vec3(2.1, 0.1, 1), 1});
    return std::accumulate(cubes.mass_kg.begin(), cubes.mass_kg.end(), 0.0) /
           (cubes.nx * cubes.ny * cubes.edge_m * cubes.edge_m);
  };
  const double before_kgpm2 = heap_kgpm2();
  soil->LetWeatherAct(kHour_ns);
  const SoilSample after = *soil->SampleBelow(2, 0, 0.05);
  EXPECT_GT(after.moisture, before.moisture + 0.01);
  EXPECT_GT(after.density_kgpm3, before.density_kgpm3 + 5);
  EXPECT_NEAR(heap_kgpm2() - before_kgpm2, 12, 0.02 * 12);
  EXPECT_GT(soil->ledger().water_kg, 12);
  EXPECT_NEAR(soil->ledger().total_kg(), 0, 1e-9);
}

// Firmness is by the soil's own density: water does not press it together.
TEST(GroundWeather, RainMakesFillHeavierButNotFirmer) {
  Columns ground = LevelColumns(Shipped("dirt"), 0.1, 41);
  ASSERT_TRUE(ground.AddHiddenKinds());
  GroundWeather weather({0, 30, 0}, false, ground);
  const SoilType dirt = ground.soils()[0];
  const ColumnId k = ground.Touch(20, 20);
  const double volume_m3 = 0.3 * ground.area_m2();
  ground.Deposit(k, Spoil{volume_m3 * LooseDensity_kgpm3(dirt), volume_m3, 0,
                          static_cast<float>(dirt.moisture)});
  const double before_kgpm3 = ground.at(k).top_layer()->density_kgpm3();
  const double firmness = FirmnessOf(ground.at(k), ground.soils());
  weather.Advance(kHour_ns);
  ground.TakeUp(*weather.TakeWater());
  EXPECT_NEAR(ground.at(k).top_layer()->density_kgpm3(), before_kgpm3 + 100, 1);  // 30 mm in 0.3 m
  EXPECT_NEAR(FirmnessOf(ground.at(k), ground.soils()) / firmness, 1, 0.01);
}

TEST(GroundWeather, StrengthFollowsMoisture) {
  const Site site = Under(kDirt, 30);
  const auto soil = MakeSoil(site, 1);
  soil->LetWeatherAct(kHour_ns);
  const SoilSample sample = *soil->SampleBelow(-4, -4, 0.02);
  const SoilType& now = soil->soils()[sample.soil];
  const SoilType expected = AtMoisture(site.soils()[0], sample.moisture);
  EXPECT_NEAR(now.moisture, sample.moisture, 0.0051);
  EXPECT_NEAR(now.cohesion_pa / expected.cohesion_pa, 1, 0.05);
  EXPECT_NEAR(now.k_phi_npm_n2 / expected.k_phi_npm_n2, 1, 0.05);
  EXPECT_LT(now.cohesion_pa, 0.7 * site.soils()[0].cohesion_pa);
  EXPECT_NEAR(sample.compaction, 1, 0.01);
}

// Bekker: z = (p / k)^(1/n), k less with what suction holds less; and as after the same hour before
// the start.
TEST(GroundWeather, ATrackSinksMoreAfterAnHourOfRain) {
  const std::string terrain = "size_m: [8, 6]\nsoil: dirt\n";
  const Site site = Under(terrain, 30);
  auto rained = MakeSoil(site, 7);
  rained->LetWeatherAct(kHour_ns);
  const SoilType& dirt = site.soils()[0];
  const double softer =
      rained->soils()[rained->SampleBelow(0, 0, 0.02)->soil].k_phi_npm_n2 / dirt.k_phi_npm_n2;
  Block dry(terrain, Vec2(0, 0)), wet(std::move(rained), Vec2(0, 0)),
      before(terrain + "weather_before: [{hours: 1, rain_mmph: 30}]\n", Vec2(0, 0));
  const auto sunk_m = [](Block* block) {
    block->Stand();
    return -block->links[0].X_WB.translation().z();
  };
  const double dry_m = sunk_m(&dry), wet_m = sunk_m(&wet);
  EXPECT_LT(softer, 0.97);
  EXPECT_NEAR(wet_m / dry_m, std::pow(softer, -1 / dirt.sinkage_exponent), 0.01);
  EXPECT_NEAR(wet_m, sunk_m(&before), 0.01 * wet_m);
  EXPECT_NEAR(wet.soil->ledger().total_kg(), 0, 1e-9);
  ::testing::Test::RecordProperty("dry_mm", std::to_string(1000 * dry_m));
  ::testing::Test::RecordProperty("wet_mm", std::to_string(1000 * wet_m));
}

// Culmann: 4 c tan(45 + phi / 2) / (rho g) is 1.25 m for dirt as it is, and 0.6 m where 10 mm/h
// pass through it. By Lu and Likos 1.2 of 2.1 kPa remain, and it is 320 kg/m^3 heavier.
TEST(GroundWeather, AWallThatSuctionHeldFallsInTheRain) {
  const Site site = Under(
      "size_m: [10, 10]\ncell_m: 0.1\nsoil: dirt\n"
      "pits: [{outline_m: [[-1.5, -1.5], [1.5, -1.5], [1.5, 1.5], [-1.5, 1.5]], depth_m: 0.9}]\n",
      10);
  const auto soil = MakeSoil(site, 1);
  const auto flow = [&] {
    for (int k = 0; k < 1500; ++k) soil->Flow(kStep_s);
  };
  const auto crest_m = [&] { return soil->surface().HeightAt(1.6, 0); };
  flow();
  EXPECT_EQ(crest_m(), 0);
  soil->LetWeatherAct(40 * kHour_ns);
  flow();
  EXPECT_LT(crest_m(), -0.1);
  EXPECT_NEAR(soil->ledger().total_kg(), 0, 1e-9);
}

TEST(GroundWeather, MoreSoilsThanThereIsRoomForAreRefused) {
  std::string soils;
  for (int k = 0; k < 60; ++k) {
    soils += "{preset: tera:config/soils/dirt.yaml, name: dirt" + std::to_string(k) + "}, ";
  }
  Site site = SiteOf("size_m: [10, 10]\nsoil: dirt3\ncustom_soils: [" + soils + "]\n");
  EXPECT_FALSE(site.LetWeatherAct({0, 5, 0}, false));
}

}  // namespace
}  // namespace tera
