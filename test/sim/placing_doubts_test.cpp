#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/machine_doubts.h"

namespace tera {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A site 30 m wide about the origin, with an excavator at `xy_m` and the additions `more`.
std::vector<std::string> DoubtsAt(const std::string& xy_m, const std::string& more = "") {
  const Config config = Config::FromText(
      "name: t\nduration_s: 2\nterrain: {size_m: [30, 30], cell_m: 0.2, soil: dirt}\nmachines:\n"
      "  - {name: digger1, machine: tera:config/machines/tb235.yaml, start: {xy_m: " +
          xy_m + "}, operator: {type: idle}}\n" + more,
      "s.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return PlacesInDoubt(scenario);
}

std::string Truck(const std::string& xy_m) {
  return "obstacles:\n  - {name: truck1, preset: tera:config/obstacles/truck.yaml, xy_m: " + xy_m +
         "}\n";
}

TEST(PlacingDoubts, AreNoneOfMachinesAndObstaclesThatStandApart) {
  EXPECT_THAT(DoubtsAt("[0, 0]", Truck("[2, 9]")), IsEmpty());
}

TEST(PlacingDoubts, NameASensorInMillimetresInRadiansAndBelowTheGround) {
  const auto mounted = [](const std::string& mount) {
    const Config config = Config::FromText(
        "name: t\nduration_s: 2\nterrain: {size_m: [30, 30], cell_m: 0.2, soil: dirt}\nmachines:\n"
        "  - name: digger1\n    machine: tera:config/machines/tb235.yaml\n    operator: {type: "
        "idle}\n"
        "    rig: {sensors: [{name: eye, preset: tera:config/sensors/os1_64.yaml, link: upper, "
        "xyz_m: " +
            mount + "}]}\n",
        "s.yaml");
    const Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return PlacesInDoubt(scenario);
  };
  EXPECT_THAT(mounted("[0.3, 0, 1.9]"), IsEmpty());
  EXPECT_THAT(mounted("[300, 0, 1900]"), ElementsAre(HasSubstr("sensor eye sits 1924 m from")));
  EXPECT_THAT(mounted("[0, 0, -1.9]"), ElementsAre(HasSubstr("sensor eye sits")));
  EXPECT_THAT(mounted("[0.3, 0, 1.9], rpy_deg: [0, 0, 90]"), IsEmpty());
  EXPECT_THAT(mounted("[0.3, 0, 1.9], rpy_deg: [0, 0.785, 0]"),
              ElementsAre(HasSubstr("sensor eye is turned by 0.785 deg: in radians?")));
  EXPECT_THAT(mounted("[0.3, 0, 1.9], rpy_deg: [0, 0, -1.5708]"),
              ElementsAre(HasSubstr("in radians?")));
}

TEST(PlacingDoubts, NameWhatStandsBesideTheSite) {
  EXPECT_THAT(DoubtsAt("[40, 0]"), ElementsAre(HasSubstr("digger1 is at (40, 0) m")));
  EXPECT_THAT(DoubtsAt("[0, 0]", Truck("[100, 0]")),
              ElementsAre(HasSubstr("truck1 is at (100, 0) m")));
}

TEST(PlacingDoubts, NameWhatBeginsInOnePlace) {
  EXPECT_THAT(DoubtsAt("[0, 0]", Truck("[0.3, 0]")),
              ElementsAre("digger1 and truck1 start at the same place"));
  EXPECT_THAT(DoubtsAt("[0, 0]",
                       "  - {name: digger2, machine: tera:config/machines/tb235.yaml, "
                       "start: {xy_m: [0.2, 0.1]}, operator: {type: idle}}\n"),
              ElementsAre("digger1 and digger2 start at the same place"));
}

// 23.3 m in a second.
TEST(PlacingDoubts, NameAPersonWhoIsFasterThanAnyRunner) {
  const auto walking = [](const std::string& until_s) {
    return DoubtsAt("[0, 0]",
                    "obstacles:\n  - {name: p1, preset: tera:config/obstacles/person.yaml, xy_m: "
                    "[8, 6], path: [{t_s: 0, xy_m: [8, 6]}, {t_s: " +
                        until_s + ", xy_m: [-12, -6]}]}\n");
  };
  EXPECT_THAT(walking("1"), ElementsAre(HasSubstr("p1 moves at 23.3 m/s")));
  EXPECT_THAT(walking("20"), IsEmpty());
}

}  // namespace
}  // namespace tera
