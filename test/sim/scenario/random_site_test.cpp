#include "sim/scenario/random_site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "core/error.h"
#include "core/units.h"
#include "own_folder.h"
#include "sim/scenario/footprint.h"
#include "sim/scenario/load_scenario.h"

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

const std::string kWhole = R"(
  - site:
      x_m: [-24, 24]
      y_m: [-24, 24]
      clear_m: 6
      gap_m: 0.5
      haul_road: {width_m: [5, 7], soils: [gravel]}
      trenches: {count: [0, 2], length_m: [4, 8], width_m: [0.8, 1.4], depth_m: [0.5, 1.2]}
      stockpiles: {count: [1, 3], height_m: [0.8, 1.6], soils: [gravel, sand]}
      berms: {count: [1, 2], length_m: [5, 10], height_m: [0.5, 1], soils: [dirt]}
      fences: {count: [1, 2], panels: [2, 4], of: ['tera:config/obstacles/fence.yaml']}
      parked: {count: [1, 2], size_m: [8, 3], of: ['tera:config/obstacles/truck.yaml']}
      people: {count: [0, 2], size_m: [1, 1], of: ['tera:config/obstacles/person.yaml']}
      things: {count: [2, 4], size_m: [1, 1], of: ['tera:config/obstacles/cone.yaml']}
)";

class RandomSite : public ::testing::Test {
 protected:
  LoadedScenario Load(const std::string& randomise, std::uint64_t episode,
                      const std::vector<std::string>& set = {}) const {
    std::ofstream(folder_ / "s.yaml") << R"(
name: test
seed: 5
duration_s: 1
terrain: {size_m: [50, 50], cell_m: 0.25, soils: [dirt, gravel, sand],
          piles: [{xy_m: [-15, 12], height_m: 1, soil: sand}]}
machines:
  - name: m
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [3, -4]}
    operator: {type: idle}
obstacles: [{name: mine, preset: 'tera:config/obstacles/rock.yaml', xy_m: [12, 12]}]
randomise:)" << randomise;
    return LoadScenario(folder_ / "s.yaml", set, {}, {}, episode);
  }

  const std::filesystem::path folder_ = OwnFolder();
};

/// The rectangle occupied by an obstacle, by its collision boxes.
std::vector<Footprint> FootprintsOf(const Scenario& scenario) {
  std::vector<Footprint> all;
  for (const ScenarioObstacle& o : scenario.obstacles) {
    Footprint f{.middle_W_m = o.xy_W_m, .yaw_rad = o.yaw_rad};
    for (const CollisionBox& box : o.collision) {
      f.half_m = f.half_m.cwiseMax(box.X_BG.translation().head<2>().cwiseAbs() +
                                   0.5 * box.size_m.head<2>());
    }
    all.push_back(f);
  }
  return all;
}

TEST_F(RandomSite, ThingsKeepApartAndMachinesStartOnFreeGround) {
  std::set<std::size_t> counts;
  for (std::uint64_t episode = 0; episode < 12; ++episode) {
    SCOPED_TRACE(episode);
    const Scenario scenario = Load(kWhole, episode).scenario;
    EXPECT_EQ(scenario.obstacles.front().name, "mine");
    counts.insert(scenario.obstacles.size());
    const std::vector<Footprint> things = FootprintsOf(scenario);
    const Footprint start{.middle_W_m = Vec2(3, -4), .half_m = Vec2::Constant(6)};
    for (std::size_t a = 0; a < things.size(); ++a) {
      EXPECT_LT(things[a].middle_W_m.cwiseAbs().maxCoeff(), 24);
      if (a > 0) {
        EXPECT_FALSE(Meet(things[a], start, 0)) << scenario.obstacles[a].name;
      }
      for (std::size_t b = 0; b < a; ++b) {
        const std::string &first = scenario.obstacles[a].name, &second = scenario.obstacles[b].name;
        const bool one_run =
            first.starts_with("fence") && first.substr(0, 8) == second.substr(0, 8);
        if (!one_run) {
          EXPECT_FALSE(Meet(things[a], things[b], 0)) << first << " " << second;
        }
      }
    }
    // The ground about the start is flat, as without the site.
    for (double x = -2.5; x <= 8.5; x += 0.5) {
      for (double y = -9.5; y <= 1.5; y += 0.5) {
        EXPECT_EQ(scenario.site->surface().HeightAt(x, y), 0) << x << " " << y;
      }
    }
    // Heaps rise above the stated one, or lie elsewhere.
    double highest_m = 0;
    for (double x = -24; x < 24; x += 0.5) {
      for (double y = -24; y < 24; y += 0.5) {
        const bool mine = (Vec2(x, y) - Vec2(-15, 12)).norm() < 2;
        if (!mine) highest_m = std::max(highest_m, scenario.site->surface().HeightAt(x, y));
      }
    }
    EXPECT_GT(highest_m, 0.45);
  }
  EXPECT_GT(counts.size(), 2u);
}

TEST_F(RandomSite, AnEpisodeIsTheSameAloneAndReadsAgainFromWhatADatasetHolds) {
  const LoadedScenario third = Load(kWhole, 3);
  EXPECT_EQ(Load(kWhole, 3).resolved_yaml, third.resolved_yaml);
  EXPECT_NE(Load(kWhole, 4).resolved_yaml, third.resolved_yaml);
  EXPECT_THAT(third.resolved_yaml, Not(HasSubstr("randomise")));
  std::ofstream(folder_ / "again.yaml") << third.resolved_yaml;
  const LoadedScenario again = LoadScenario(folder_ / "again.yaml", {}, {}, {}, 0);
  EXPECT_EQ(again.resolved_yaml, third.resolved_yaml);
  EXPECT_EQ(again.scenario.site->surface().HeightAt(-15, 12),
            third.scenario.site->surface().HeightAt(-15, 12));
}

TEST_F(RandomSite, WhatOtherEntriesDrawForItemsHoldsAndIsAvoided) {
  const std::string moved = R"(
  - {key: 'obstacles[0].xy_m', choice: [[0, 10]]}
  - {key: 'machines[0].start.xy_m', choice: [[-10, -10]]})";
  for (std::uint64_t episode = 0; episode < 4; ++episode) {
    const Scenario scenario = Load(moved + kWhole, episode).scenario;
    EXPECT_EQ(scenario.obstacles[0].xy_W_m, Vec2(0, 10));
    const std::vector<Footprint> things = FootprintsOf(scenario);
    for (std::size_t a = 1; a < things.size(); ++a) {
      EXPECT_FALSE(Meet(things[a], {.middle_W_m = Vec2(-10, -10), .half_m = Vec2(6, 6)}, 0));
      EXPECT_FALSE(Meet(things[a], things[0], 0)) << scenario.obstacles[a].name;
    }
  }
}

// Patches change the soil, and driven ground is lower: somewhere both apply.
TEST_F(RandomSite, PatchesAndTracksChangeTheGroundAndPlantsStandOnIt) {
  const std::string used = R"(
  - site:
      x_m: [-24, 24]
      y_m: [-24, 24]
      patches: {count: [3, 3], size_m: [4, 6], soils: [sand]}
      tracks: {count: [2, 2], gauge_m: 1.6, width_m: 0.5, depth_m: [0.08, 0.08]}
      plants: {count: [4, 4], size_m: [0.5, 0.5], of: ['tera:config/obstacles/tuft.yaml']}
)";
  const LoadedScenario loaded = Load(used, 2);
  const TerrainSurface& ground = loaded.scenario.site->surface();
  int sandy = 0, pressed = 0;
  for (double x = -24; x < 24; x += 0.25) {
    for (double y = -24; y < 24; y += 0.25) {
      if ((Vec2(x, y) - Vec2(-15, 12)).norm() < 3) continue;  // the heap of sand
      const auto column = [&](double w_m, double origin_m) {
        return static_cast<int>(std::lround((w_m - origin_m) / ground.cell_m));
      };
      const int i = column(x, ground.origin_W_m.x()), j = column(y, ground.origin_W_m.y());
      sandy += ground.at(i, j).cover.soil == 2 ? 1 : 0;
      pressed += ground.HeightAt(x, y) < -0.02 ? 1 : 0;
    }
  }
  const double cell_m2 = 0.25 * 0.25;
  EXPECT_GT(sandy * cell_m2, kPi * 2 * 2 * 0.9) << "the smallest of three that lie over each other";
  EXPECT_LT(sandy * cell_m2, 3 * kPi * 3 * 3 * 1.1);
  EXPECT_GT(pressed * cell_m2, 2 * 0.4 * 20) << "two ruts of at least 20 m";
  EXPECT_EQ(loaded.scenario.obstacles.size(), 1u + 4u);
  EXPECT_EQ(loaded.scenario.obstacles.back().label, SemanticClass::kVegetation);
  EXPECT_EQ(Load(used, 2).resolved_yaml, loaded.resolved_yaml);
}

TEST_F(RandomSite, CommandLineOverridesLieAboveWhatIsDrawn) {
  const Scenario scenario = Load(kWhole, 0, {"obstacles[1].name=renamed"}).scenario;
  EXPECT_EQ(scenario.obstacles[1].name, "renamed");
}

TEST_F(RandomSite, FaultsSayWhereTheyAre) {
  const auto site = [](const std::string& keys) {
    return "\n  - site: {x_m: [-20, 20], y_m: [-20, 20], " + keys + "}\n";
  };
  const auto load = [&](const std::string& keys) { return [=, this] { Load(site(keys), 0); }; };
  EXPECT_THAT(load("berms: {count: [0, 0], length_m: [5, 6], hieght_m: [1, 1], soils: [dirt]}"),
              ThrowsMessage<InputError>(HasSubstr("hieght_m")));
  EXPECT_THAT(load("stockpiles: {count: [60, 60], height_m: [3, 3], soils: [dirt]}"),
              ThrowsMessage<InputError>(AllOf(HasSubstr("randomise[0].site.stockpiles"),
                                              HasSubstr("no free place found"))));
  EXPECT_THAT(
      load("trenches: {count: [1, 0.5], length_m: [1, 2], width_m: [1, 1], depth_m: [1, 1]}"),
      ThrowsMessage<InputError>(HasSubstr("the ends are swapped")));
  EXPECT_THAT(load("things: {count: [1, 1], size_m: [1, 1], of: []}"),
              ThrowsMessage<InputError>(HasSubstr("nothing to choose from")));
  EXPECT_THAT(load("things: {count: [1, 1], size_m: [1, 1], of: ['no.yaml']}"),
              ThrowsMessage<InputError>(HasSubstr("'no.yaml' does not exist")));
  EXPECT_THAT(
      load("fences: {count: [1, 1], panels: [1.5, 2.7], of: ['tera:config/obstacles/fence.yaml']}"),
      ThrowsMessage<InputError>(HasSubstr("panels: from 1.5 to 2.7; need whole numbers")));
  // A text stays a text with any characters.
  EXPECT_THAT(load("patches: {count: [1, 1], size_m: [1, 1], soils: ['sand}']}"),
              ThrowsMessage<InputError>(HasSubstr("sand}")));
  EXPECT_THAT(load("plants: {count: [1, 1], size_m: [1, 1], of: [\"it's.yaml\"]}"),
              ThrowsMessage<InputError>(HasSubstr("it's.yaml' does not exist")));
  EXPECT_THAT(load("patches: {count: [1, 1], size_m: [1, 1], soils: []}"),
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("nothing to choose from"), Not(HasSubstr("regions")))));
  EXPECT_THAT(load("tracks: {count: [0, 0], gauge_m: 0.3, width_m: 0.4, depth_m: [0.1, 0.1]}"),
              ThrowsMessage<InputError>(AllOf(HasSubstr("randomise[0].site.tracks.gauge_m"),
                                              HasSubstr("lie over each other"))));
  EXPECT_THAT([&] { Load("\n  - site: {x_m: [-2e6, 2e6], y_m: [0, 1]}\n", 0); },
              ThrowsMessage<InputError>(HasSubstr("is out of range")));
  EXPECT_THAT([&] { Load(site("gap_m: 1") + site("gap_m: 1").substr(1), 0); },
              ThrowsMessage<InputError>(HasSubstr("is the second site")));
  EXPECT_THAT(load("gap_m: -1"), ThrowsMessage<InputError>(HasSubstr("gap_m: -1 is out of range")));
}

}  // namespace
}  // namespace tera
