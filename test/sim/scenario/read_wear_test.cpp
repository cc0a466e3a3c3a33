#include "sim/scenario/read_wear.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using enum FaultKind;

std::string WornSite(const std::string& root, const std::string& machine,
                     const std::string& obstacle) {
  return std::string(kSite) + root + kExcavator + machine +
         "obstacles: [{name: truck1, preset: 'tera:config/obstacles/truck.yaml', xy_m: [3, 3]" +
         obstacle + "}]\n";
}

Scenario WornScenario(const std::string& text) {
  const Config config = Config::FromText(text, "s.yaml", {});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

TEST(ReadWear, WithoutItEverythingIsNew) {
  const Scenario scenario = WornScenario(WornSite("", "", ""));
  EXPECT_FALSE(scenario.machines[0].wear.any());
  EXPECT_FALSE(scenario.obstacles[0].wear.any());
}

TEST(ReadWear, ThatOfTheScenarioIsOfAllAndEachMayDiffer) {
  const Scenario scenario = WornScenario(
      WornSite("wear: {dust: 0.3, mud: 0.2}\n", "    wear: {mud: 0.7}\n", ", wear: {rust: 0.4}"));
  EXPECT_EQ(scenario.machines[0].wear, (Wear{.dust = 0.3, .mud = 0.7}));
  EXPECT_EQ(scenario.obstacles[0].wear, (Wear{.dust = 0.3, .mud = 0.2, .rust = 0.4}));
}

TEST(ReadWear, EveryFaultIsNamed) {
  EXPECT_THAT(ScenarioFaults(WornSite("wear: {mud: 1.5}\n", "", "")),
              HasFault(kOutOfRange, "wear.mud"));
  EXPECT_THAT(ScenarioFaults(WornSite("", "    wear: {dirt: 0.5}\n", "")),
              HasFault(kUnknown, "machines[0].wear.dirt"));
}

}  // namespace
}  // namespace tera
