#include "sim/scenario/read_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.h"
#include "core/units.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using enum FaultKind;

std::string Site(const std::string& more) { return std::string(kSite) + more + kExcavator; }

Scenario LitScenario(const std::string& yaml) {
  const Config config = Config::FromText(yaml, "s.yaml", {});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

TEST(ReadLight, TimeGivesTheSunOfThePlace) {
  // The sun of sun_test.cpp: 39.888 degrees high, 194.34 from north.
  const Scenario scenario =
      LitScenario(Site("site: {lat_deg: 39.742476, lon_deg: -105.1786, height_m: 1830}\n"
                       "environment: {time: '2003-10-17T19:30:30Z'}\n"));
  const Environment& environment = scenario.environment;
  EXPECT_NEAR(std::asin(environment.to_sun_W.z()) / kDeg, 39.888, 0.02);
  EXPECT_NEAR(environment.sun_illuminance_klx, 127.5 * std::exp(-0.21 / 0.6413), 0.1);
  EXPECT_FALSE(environment.sky_illuminance_lx) << "its model holds by day";
  // 91.9 klx times 0.641, and 800 + 15500 sqrt(0.641) lx of the sky: 72.1 klx, 14.8 EV.
  EXPECT_NEAR(environment.exposure_ev100, 14.8, 0.05);
}

TEST(ReadLight, NightHasNoSun) {
  const Environment night =
      LitScenario(Site("environment: {time: '2026-12-21T23:00:00Z'}\n")).environment;
  EXPECT_EQ(night.sun_illuminance_klx, 0);
  ASSERT_TRUE(night.sky_illuminance_lx);
  EXPECT_LT(*night.sky_illuminance_lx, 0.001);
  EXPECT_NEAR(night.exposure_ev100, std::log2(30.0 * 100 / 250), 1e-9) << "30 lx of lamps";
}

TEST(ReadLight, ExposureAndSunCanStillBeGiven) {
  const Environment environment =
      LitScenario(Site("environment: {time: '2026-06-21T10:00:00Z', exposure_ev100: 9, "
                       "sun_illuminance_klx: 55, cloud_cover: 0.8}\n"))
          .environment;
  EXPECT_EQ(environment.exposure_ev100, 9);
  EXPECT_EQ(environment.sun_illuminance_klx, 55);
  EXPECT_EQ(environment.cloud_cover, 0.8);
}

TEST(ReadLight, RefusesWhatContradictsOrIsNoTime) {
  EXPECT_THAT(
      ScenarioFaults(Site("environment: {time: '2026-06-21T10:00:00Z', sun_elevation_deg: 3}\n")),
      HasFault(kInconsistent, "environment.sun_elevation_deg"));
  EXPECT_THAT(ScenarioFaults(Site("environment: {time: '21 June'}\n")),
              HasFault(kMistyped, "environment.time"));
  EXPECT_THAT(ScenarioFaults(Site("environment: {cloud_cover: 1.5}\n")),
              HasFault(kOutOfRange, "environment.cloud_cover"));
}

TEST(ReadLight, RefusesASunThatShinesAtNight) {
  EXPECT_THAT(
      ScenarioFaults(Site("environment: {time: '2026-12-21T23:00:00Z', sun_illuminance_klx: "
                          "50}\n")),
      HasFault(kInconsistent, "environment.sun_illuminance_klx"));
}

TEST(ReadLight, LampsHangOnLinksOrStandOnTheSite) {
  const Scenario scenario =
      LitScenario(Site("lamps:\n"
                       "  - {machine: excavator1, link: boom, xyz_m: [1, 0, 0.3], rpy_deg: [0, 20, "
                       "0], flux_lm: 2500, beam_deg: 60}\n"
                       "  - {xyz_m: [4, 4, 6], rpy_deg: [0, 45, -135], flux_lm: 40000, beam_deg: "
                       "100}\n"));
  ASSERT_EQ(scenario.lamps.size(), 2u);
  EXPECT_EQ(scenario.lamps[0].link, "boom");
  EXPECT_NEAR(scenario.lamps[0].half_angle_rad, 30 * kDeg, 1e-12);
  // A positive pitch looks down.
  EXPECT_LT((scenario.lamps[1].X_PL.linear().col(0).z()), -0.7);
}

TEST(ReadLight, RefusesLampsOnWhatIsNotThere) {
  const std::string rest = ", xyz_m: [0, 0, 1], flux_lm: 100, beam_deg: 60}\n";
  EXPECT_THAT(ScenarioFaults(Site("lamps:\n  - {machine: excavator2" + rest)),
              HasFault(kNoSuchName, "lamps[0].machine"));
  EXPECT_THAT(ScenarioFaults(Site("lamps:\n  - {machine: excavator1, link: bom" + rest)),
              HasFault(kNoSuchName, "link"));
  EXPECT_THAT(ScenarioFaults(Site("lamps:\n  - {xyz_m: [0, 0, 1], flux_lm: -1, beam_deg: 60}\n")),
              HasFault(kOutOfRange, "lamps[0].flux_lm"));
  EXPECT_THAT(ScenarioFaults(Site("lamps:\n  - {name: mast" + rest)),
              HasFault(kUnknown, "lamps[0].name"));
  std::string nine = "lamps:\n";
  for (int k = 0; k < 9; ++k) nine += "  - {" + rest.substr(2);
  EXPECT_THAT(ScenarioFaults(Site(nine)), HasFault(kOutOfRange, "lamps"));
}

}  // namespace
}  // namespace tera
