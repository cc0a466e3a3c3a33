#include "serve/scenario_source.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "serve/live_stage_fixture.h"

namespace tera {
namespace {

constexpr const char* kDrawn = R"(
randomise:
  - {key: environment.sun_elevation_deg, uniform: [10, 60]}
  - {key: 'machines[1].start.yaw_deg', uniform: [-90, 90]}
  - {key: terrain.soil, choice: [dirt, clay, sand]}
)";

TEST(ScenarioSource, GivesOneScenarioForItsOwnSeedAndAnotherForAnother) {
  const ScenarioSource source = SourceOfText(kStageScenario, "stage.yaml");
  const SeededScenario own = source(std::nullopt);
  EXPECT_EQ(source(std::nullopt).scenario, own.scenario);
  EXPECT_EQ(source(own.scenario->seed).scenario, own.scenario);
  const SeededScenario other = source(own.scenario->seed + 1);
  EXPECT_EQ(other.scenario->seed, own.scenario->seed + 1);
  EXPECT_NE(other.resolved_yaml, own.resolved_yaml);
  EXPECT_EQ(source(own.scenario->seed + 1).scenario, other.scenario);
  EXPECT_EQ(SourceOfText(other.resolved_yaml, "again.yaml")(std::nullopt).scenario->seed,
            own.scenario->seed + 1);
}

TEST(ScenarioSource, DrawsAnewBySeedAsGenerateDoes) {
  const std::string text = std::string(kStageScenario) + kDrawn;
  const ScenarioSource source = SourceOfText(text, "drawn.yaml");
  const auto drawn = [&](std::uint64_t seed) { return source(seed).scenario->drawn; };
  const std::vector<std::string> first = drawn(1), second = drawn(2);
  ASSERT_EQ(first.size(), 3u);
  EXPECT_NE(first, second);
  EXPECT_EQ(drawn(1), first);
  const LoadedScenario generated = LoadScenario(OwnFolder() / "drawn.yaml", {"seed=2"}, {}, {}, 0);
  EXPECT_EQ(source(2).resolved_yaml, generated.resolved_yaml);
}

TEST(ScenarioSource, KeepsAllFilesAsTheyWereAtTheStart) {
  const std::filesystem::path obstacle = OwnFolder() / "cone.yaml";
  const std::string cone = "{preset: tera:config/obstacles/cone.yaml, height_above_ground_m: ";
  std::ofstream(obstacle) << cone << "0.5}";
  const std::string text =
      std::string(kStageScenario) + "obstacles: [{name: cone, preset: cone.yaml, xy_m: [3, 3]}]\n";
  const ScenarioSource source = SourceOfText(text, "kept.yaml");
  std::ofstream(obstacle) << cone << "0.75}";
  EXPECT_EQ(source(99).scenario->obstacles.at(0).height_above_ground_m, 0.5);
}

TEST(ScenarioSource, RefusesAFaultyTextAtOnce) {
  EXPECT_THROW(SourceOfText(std::string(kStageScenario) + "unknown_key: 1\n", "stage.yaml"),
               InputError);
}

}  // namespace
}  // namespace tera
