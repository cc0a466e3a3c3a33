#include "sim/dust/site_dust.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/scenario/scenario_text.h"
#include "sim/simulation.h"

namespace tera {
namespace {

double SiteDustSum(const DustMass& mass) { return std::accumulate(mass.begin(), mass.end(), 0.0); }

std::string Dusty(double moisture, const std::string& environment = "") {
  return fmt::format(
      "\nname: test\nduration_s: 1\nsettle_s: 0\n"
      "terrain: {{size_m: [12, 12], cell_m: 0.1, soil: mine, custom_soils: [{{preset: "
      "tera:config/soils/dirt.yaml, name: mine, moisture: {}}}]}}\n"
      "environment: {{wind_mps: 3, dust: {{extent_m: 20}}{}}}\n{}",
      moisture, environment, kExcavator);
}

Scenario Read(const std::string& yaml) {
  const Config config = Config::FromText(yaml, "s.yaml", {});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

constexpr double kDry = 0.02, kMoist = 0.3;

/// Dust after 100 steps of 2 ms, in each of which the first shovel takes up 1 kg, or the tracks
/// run.
struct Worked {
  Scenario scenario;
  Simulation simulation;
  Instant before, after;
  SiteDust dust;

  explicit Worked(const std::string& yaml)
      : scenario(Read(yaml)),
        simulation(scenario),
        before(simulation.state()),
        after(simulation.state()),
        dust(scenario, before, simulation.ground()) {
    const GroundTools& tools = scenario.machines[0].placement.model.ground_tools;
    after.machines[0].shovel_load.resize(tools.shovels.size());
    after.machines[0].gear_rate_radps.resize(tools.gears.size());
  }
  void Run(double taken_kg, double gear_radps) {
    for (int step = 0; step < 100; ++step) {
      before = after;
      after.t_ns += 2 * kNsPerSecond / 1000;
      for (double& rate_radps : after.machines[0].gear_rate_radps) rate_radps = gear_radps;
      after.machines[0].shovel_load[0].mass_kg += taken_kg;
      dust.Step({before, after, simulation.ground()});
    }
  }
  double emitted_kg() const { return SiteDustSum(dust.field().budget().emitted_kg); }
};

TEST(SiteDust, SoilTakenUpRaisesWhatAp42SaysOfItsMassAndMoisture) {
  Worked dry(Dusty(kDry));
  dry.Run(1, 0);
  // Dirt with 2 % of its pores full: 0.02 (1 / 1474 - 1 / 2650) 1000 = 0.602 % water. The cover
  // stores the degree of saturation in 255ths, hence 5 / 255 of it.
  const double moisture = 5 / 255.0 * 100 * (1000 / 1474.0 - 1000 / 2650.0);
  const double expected_kg =
      0.1 * 0.74 * 0.0016 * std::pow(3 / 2.2, 1.3) / std::pow(moisture / 2, 1.4);
  EXPECT_NEAR(dry.emitted_kg(), expected_kg, 0.01 * expected_kg);
  Worked moist(Dusty(kMoist));
  moist.Run(1, 0);
  EXPECT_LT(moist.emitted_kg(), 0.05 * dry.emitted_kg());
  EXPECT_FALSE(dry.dust.volume().occupied_W_m.isEmpty());
}

TEST(SiteDust, DrivingRaisesWhatAp42SaysOfItsWay) {
  Worked dry(Dusty(kDry));
  const GroundTools& tools = dry.scenario.machines[0].placement.model.ground_tools;
  dry.Run(0, 2.0);
  const double way_km = 2.0 * tools.gears[0].ShoeRadius_m() * 0.2 / 1000;
  const double moisture = 5 / 255.0 * 100 * (1000 / 1474.0 - 1000 / 2650.0);
  const double expected_kg =
      way_km * MoistRoadShare(moisture) * SiteDustSum(RoadEmission_kgpkm(8.5, tools.mass_kg));
  EXPECT_NEAR(dry.emitted_kg(), expected_kg, 0.01 * expected_kg);
  Worked wet(Dusty(kDry, ", rain_mmph: 3, cloud_cover: 1"));
  wet.Run(0, 2.0);
  EXPECT_LT(wet.emitted_kg(), 1e-3 * dry.emitted_kg());
  Worked snowy(Dusty(kDry, ", snow_depth_m: 0.1"));
  snowy.Run(0, 2.0);
  EXPECT_EQ(snowy.emitted_kg(), 0);
}

TEST(SiteDust, ClodsRaiseDustWhereTheyLandByTheirFall) {
  Worked work(Dusty(kDry));
  TerrainSurface ground = work.simulation.ground();
  const double radius_m = 0.029;
  const auto fall = [&](double height_m, int step) {
    TerrainSurface::Grain clod;
    clod.p_W_m = Eigen::Vector3f(1, 2, static_cast<float>(height_m));
    clod.radius_m = static_cast<float>(radius_m);
    clod.number = 7;
    clod.moisture = 5;
    ground.SetGrains({clod});
    work.before = work.after;
    work.after.t_ns += SiteDust::kStep_ns;
    work.dust.Step({work.before, work.after, ground});
    EXPECT_EQ(work.emitted_kg(), 0) << step;
  };
  for (int step = 0; step <= 10; ++step) fall(1.6 - 0.15 * step, step);
  ground.SetGrains({});
  work.before = work.after;
  work.after.t_ns += SiteDust::kStep_ns;
  work.dust.Step({work.before, work.after, ground});
  const double moisture = 5 / 255.0 * 100 * (1000 / 1474.0 - 1000 / 2650.0);
  const double mass_t = 4 * M_PI / 3 * std::pow(radius_m, 3) * 1474 / 1.1 / 1000;
  const double expected_kg =
      mass_t * SiteDustSum(DropEmission_kgpt(3, moisture));  // of a fall of 1.5 m
  EXPECT_NEAR(work.emitted_kg(), expected_kg, 0.01 * expected_kg);
}

TEST(DustSources, AGaleTakesHalfOfLooseGroundsPotentialInTwoMinutes) {
  // 30 m/s: u* is 0.4 30 / ln 2000 = 1.579 m/s, so that 58 0.559^2 + 25 0.559 = 32.1 g/m^2 may
  // leave. A square of 21 x 21 vertices 0.1 m apart is loose: 4.41 m^2.
  Scenario scenario = Read(Dusty(0));
  scenario.environment.weather.wind.speed_mps = 30;
  DustSources sources(scenario);
  TerrainSurface ground = Simulation(scenario).ground();
  for (int j = 0; j <= 20; ++j) {
    for (int i = 0; i <= 20; ++i) {
      TerrainSurface::Vertex vertex = ground.at(40 + i, 60 + j);
      vertex.cover.looseness = 255;
      ground.Set(40 + i, 60 + j, vertex);
    }
  }
  std::vector<DustPuff> puffs;
  sources.AddBlown(ground, 120, &puffs);
  double blown_kg = 0;
  for (const DustPuff& puff : puffs) blown_kg += SiteDustSum(puff.mass_kg);
  EXPECT_NEAR(blown_kg, 0.5 * 4.41 * 0.0321, 0.01 * blown_kg);
  puffs.clear();
  sources.AddBlown(ground, 120, &puffs);
  double next_kg = 0;
  for (const DustPuff& puff : puffs) next_kg += SiteDustSum(puff.mass_kg);
  EXPECT_NEAR(next_kg, 0.5 * blown_kg, 1e-9);
  scenario.environment.weather.wind.speed_mps = 15;
  puffs.clear();
  DustSources(scenario).AddBlown(ground, 120, &puffs);
  EXPECT_TRUE(puffs.empty()) << "below the threshold";
}

TEST(SiteDust, TheSameWorkGivesTheSameDust) {
  Worked a(Dusty(kDry)), b(Dusty(kDry));
  a.Run(0.5, 1);
  b.Run(0.5, 1);
  EXPECT_EQ(a.dust.volume().extinction_1pm, b.dust.volume().extinction_1pm);
  EXPECT_EQ(a.dust.volume().drift_m, b.dust.volume().drift_m);
}

}  // namespace
}  // namespace tera
