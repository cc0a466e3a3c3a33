#include "sim/scenario/read_weather.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.h"
#include "core/units.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using enum FaultKind;

std::string SiteWithWeather(const std::string& environment) {
  return std::string(kSite) + "environment: {" + environment + "}\n" + kExcavator;
}

Environment ReadEnvironment(const std::string& environment) {
  const Config config = Config::FromText(SiteWithWeather(environment), "s.yaml", {});
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario.environment;
}

TEST(ReadWeather, NothingIsCalmAndDry) {
  const Environment environment = ReadEnvironment("");
  EXPECT_FALSE(environment.weather.dust);
  EXPECT_EQ(environment.weather.wind.speed_mps, 0);
  EXPECT_EQ(environment.weather.rain_mmph, 0);
  EXPECT_EQ(environment.weather.snow_depth_m, 0);
  EXPECT_EQ(environment.fog_visibility_m, 2000);
}

TEST(ReadWeather, WindIsNamedByWhereItComesFrom) {
  const Weather weather =
      ReadEnvironment("wind_mps: 6, wind_from_deg: 270, dust: {silt_percent: 12}").weather;
  EXPECT_NEAR(weather.wind.towards_W().x(), 1, 1e-12) << "a west wind blows to the east";
  EXPECT_NEAR(weather.wind.towards_W().y(), 0, 1e-12);
  ASSERT_TRUE(weather.dust);
  EXPECT_EQ(weather.dust->silt_percent, 12);
  EXPECT_EQ(weather.dust->emission_factor, 1);
}

TEST(ReadWeather, RainTakesItsPartOfTheVisibility) {
  // 25 mm/h by Marshall and Palmer: pi 8e6 / (4100 25^-0.21)^3 = 2.77 / km. A contrast of 2 % over
  // 2 km adds 1.956 / km.
  const Environment rain = ReadEnvironment("rain_mmph: 25, cloud_cover: 1");
  EXPECT_NEAR(rain.fog_visibility_m, std::log(50.0) / (2.77e-3 + 1.956e-3), 2);
}

TEST(ReadWeather, RefusesWeatherThatContradictsItself) {
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("rain_mmph: 5")), HasFaultAt("environment.rain_mmph"));
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("rain_mmph: 5, cloud_cover: 0.2")),
              HasFaultAt("environment.rain_mmph"));
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("snow_depth_m: 0.1, temperature_degc: 30")),
              HasFault(kOutOfRange, "environment.snow_depth_m"));
  EXPECT_THAT(
      ScenarioFaults(SiteWithWeather("rain_mmph: 5, cloud_cover: 1, temperature_degc: -20")),
      HasFault(kOutOfRange, "environment.rain_mmph"));
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("rain_mmph: 5, cloud_cover: 1, temperature_degc: 12")),
              testing::IsEmpty());
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("snow_depth_m: 0.1, temperature_degc: -3")),
              testing::IsEmpty());
}

TEST(ReadWeather, RefusesWhatIsOutOfRange) {
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("rain_mmph: -1, cloud_cover: 1")),
              HasFault(kOutOfRange, "environment.rain_mmph"));
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("rain_mmph: 4000, cloud_cover: 1")),
              HasFault(kOutOfRange, "environment.rain_mmph"));
  for (const char* evaporation : {"-0.5", "200"}) {
    EXPECT_THAT(ScenarioFaults(SiteWithWeather(std::string("evaporation_mmpd: ") + evaporation)),
                HasFault(kOutOfRange, "environment.evaporation_mmpd"));
  }
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("wind_mps: -3")),
              HasFault(kOutOfRange, "environment.wind_mps"));
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("dust: {emission_factor: -1}")),
              HasFault(kOutOfRange, "environment.dust.emission_factor"));
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("dust: {slit_percent: 3}")),
              HasFault(kUnknown, "environment.dust.slit_percent"));
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("dust: {extent_m: 400, cell_m: 0.2}")),
              HasFault(kOutOfRange, "environment.dust.cell_m"));
}

TEST(ReadWeather, RainAndEvaporationActOnTheGround) {
  const auto acts = [](const std::string& environment) {
    const Config config = Config::FromText(SiteWithWeather(environment), "s.yaml", {});
    return ReadScenario(config.root()).site->weather().has_value();
  };
  EXPECT_TRUE(acts("rain_mmph: 2, cloud_cover: 1"));
  EXPECT_TRUE(acts("evaporation_mmpd: 4"));
  EXPECT_FALSE(acts("evaporation_mmpd: 0, rain_mmph: 0"));
  EXPECT_FALSE(acts(""));
}

// A recording keeps the resolved scenario, which replay and resense read with equal results.
TEST(ReadWeather, AResolvedScenarioHasTheSameAirAndGround) {
  const Config given = Config::FromText(SiteWithWeather("rain_mmph: 9, cloud_cover: 1"), "s.yaml");
  const Scenario scenario = ReadScenario(given.root());
  const Config resolved = Config::FromText(given.ResolvedYaml(), "resolved.yaml");
  const Scenario again = ReadScenario(resolved.root());
  EXPECT_EQ(again.environment.weather.visibility_m, scenario.environment.weather.visibility_m);
  EXPECT_EQ(again.environment.fog_visibility_m, scenario.environment.fog_visibility_m);
  EXPECT_EQ(again.site->surface().at(9, 9).cover, scenario.site->surface().at(9, 9).cover);
}

TEST(ReadWeather, RefusesWeatherOverMoreSoilsThanItCanChange) {
  std::string soils;
  for (int k = 0; k < 60; ++k) {
    soils += "{preset: 'tera:config/soils/dirt.yaml', name: dirt" + std::to_string(k) + "}, ";
  }
  std::string text = SiteWithWeather("evaporation_mmpd: 3");
  const std::string one = "soil: dirt}";
  text.replace(text.find(one), one.size(), "soil: dirt5, custom_soils: [" + soils + "]}");
  EXPECT_THAT(ScenarioFaults(text), HasFault(kOutOfRange, "environment.evaporation_mmpd"));
}

TEST(ReadWeather, OnlyAStatedVisibilityIsFog) {
  EXPECT_EQ(ReadEnvironment("").weather.visibility_m, 0);
  EXPECT_EQ(ReadEnvironment("").weather.Extinction_1pm(), 0);
  const Environment fog = ReadEnvironment("visibility_m: 150");
  EXPECT_EQ(fog.weather.visibility_m, 150);
  EXPECT_NEAR(fog.weather.Extinction_1pm(), std::log(50.0) / 150, 1e-12);
  // Rain reduces the picture's visibility, not the fog's.
  const Environment both = ReadEnvironment("visibility_m: 150, rain_mmph: 25, cloud_cover: 1");
  EXPECT_EQ(both.weather.visibility_m, 150);
  EXPECT_NEAR(both.weather.Extinction_1pm(), std::log(50.0) / 150 + 2.77e-3, 1e-5);
  EXPECT_NEAR(both.fog_visibility_m, std::log(50.0) / both.weather.Extinction_1pm(), 1e-6);
}

TEST(ReadWeather, SnowFallsFromCloudsInTheCold) {
  EXPECT_EQ(ReadEnvironment("snowfall_mmph: 2, cloud_cover: 1").weather.snowfall_mmph, 2);
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("snowfall_mmph: 2")),
              HasFaultAt("environment.snowfall_mmph"));
  EXPECT_THAT(
      ScenarioFaults(SiteWithWeather("snowfall_mmph: 2, cloud_cover: 1, temperature_degc: 12")),
      HasFault(kOutOfRange, "environment.snowfall_mmph"));
  EXPECT_THAT(ScenarioFaults(SiteWithWeather("snowfall_mmph: 50, cloud_cover: 1")),
              HasFault(kOutOfRange, "environment.snowfall_mmph"));
}

}  // namespace
}  // namespace tera
