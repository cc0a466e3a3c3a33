#include "sim/scenario/task_of_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/config.h"
#include "core/faults.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using enum FaultKind;

constexpr const char* kDigger = R"(
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-1, 0]}
    operator: {type: dig_to_design}
)";
constexpr const char* kTrench =
    "task: {trench: {from_m: [3.4, 0], to_m: [-2, 0], width_m: 0.6, depth_m: 1}}\n";

std::vector<InputFault> Faults(const std::vector<std::string>& overrides = {}) {
  return ScenarioFaults(std::string(kSite) + kDigger + kTrench, overrides);
}

TEST(TaskOfMachine, IsATrenchThatItsArmReaches) {
  EXPECT_THAT(Faults(), testing::IsEmpty());
  const Config config = Config::FromText(std::string(kSite) + kDigger + kTrench, "s.yaml");
  const Scenario scenario = ReadScenario(config.root());
  const auto& plan = std::get<DigPlan>(scenario.machines[0].driver);
  ASSERT_TRUE(plan.trench);
  EXPECT_GT(plan.trench->near_m, 1.5);  // the blade's edge is 1.5 m before the slew axis
  EXPECT_LT(plan.trench->far_m, 5.2);   // the arm's reach at the ground
}

TEST(TaskOfMachine, RefusesADepthBeyondItsReach) {
  EXPECT_THAT(Faults({"task.trench.depth_m=4"}), HasOnlyFault(kOutOfRange, "task.trench.depth_m"));
}

TEST(TaskOfMachine, RefusesATrenchNarrowerThanItsBucket) {
  EXPECT_THAT(Faults({"task.trench.width_m=0.5"}),
              HasOnlyFault(kOutOfRange, "task.trench.width_m"));
}

TEST(TaskOfMachine, RefusesAStartOffTheLineOrFacingAway) {
  EXPECT_THAT(Faults({"machines[0].start={xy_m: [-1, 2]}"}),
              HasOnlyFault(kInconsistent, "machines[0].start"));
  EXPECT_THAT(Faults({"machines[0].start={xy_m: [-1, 0], yaw_deg: 90}"}),
              HasOnlyFault(kInconsistent, "machines[0].start"));
  EXPECT_THAT(Faults({"machines[0].start={xy_m: [5, 0]}"}),
              HasOnlyFault(kInconsistent, "machines[0].start"));
}

TEST(TaskOfMachine, IsNeededByAnOperatorThatDigsToADesign) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kDigger),
              HasOnlyFault(kMissing, "machines[0].operator.type"));
}

TEST(TaskOfMachine, OfAPitIsNotForAnOperator) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kDigger +
                             "task: {pit: {corners_m: [[0, 0], [1, 0], [0, 1]], depth_m: 1}}\n"),
              HasOnlyFault(kUnsupported, "machines[0].operator.type"));
}

}  // namespace
}  // namespace tera
