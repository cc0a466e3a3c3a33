#include "serve/scenario_source.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "serve/live_stage_fixture.h"

namespace tera {
namespace {

TEST(ScenarioSource, GivesOneScenarioForItsOwnSeedAndAnotherForAnother) {
  const ScenarioSource source = SourceOf(kStageScenario, "stage.yaml");
  const SeededScenario own = source(std::nullopt);
  EXPECT_EQ(source(std::nullopt).scenario, own.scenario);
  EXPECT_EQ(source(own.scenario->seed).scenario, own.scenario);
  const SeededScenario other = source(own.scenario->seed + 1);
  EXPECT_EQ(other.scenario->seed, own.scenario->seed + 1);
  EXPECT_NE(other.resolved_yaml, own.resolved_yaml);
  EXPECT_EQ(SourceOf(other.resolved_yaml, "again.yaml")(std::nullopt).scenario->seed,
            own.scenario->seed + 1);
}

TEST(ScenarioSource, RefusesAFaultyTextAtOnce) {
  EXPECT_THROW(SourceOf(std::string(kStageScenario) + "unknown_key: 1\n", "stage.yaml"),
               InputError);
}

}  // namespace
}  // namespace tera
