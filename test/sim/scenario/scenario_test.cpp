#include "sim/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/config.h"
#include "core/faults.h"
#include "core/units.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using enum FaultKind;
using ::testing::AllOf;

TEST(ReadScenario, AcceptsTheSmallestOne) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator), testing::IsEmpty());
}

TEST(ReadScenario, RefusesAnUnknownKeyWithItsPlace) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + "phisics_rate_hz: 500\n" + kExcavator),
              HasOnlyFault(kUnknown, "s.yaml:5:1: phisics_rate_hz"));
}

TEST(ReadScenario, RefusesTwoSensorsWithOneName) {
  const std::string imu = "{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom}";
  EXPECT_THAT(ScenarioFaults(WithRig(imu + ", " + imu)),
              HasFault(kRepeated, "machines[0].rig.sensors[1].name"));
}

TEST(ReadScenario, RefusesAnObstacleNamedAsTheWallsOfTheSite) {
  const auto named = [](const std::string& name) {
    return ScenarioFaults(std::string(kSite) + kExcavator + "obstacles: [{name: " + name +
                          ", preset: tera:config/obstacles/cone.yaml, xy_m: [3, 3]}]\n");
  };
  EXPECT_TRUE(named("sites").empty());
  EXPECT_THAT(named("site"), HasOnlyFault(kInconsistent, "obstacles"));
}

TEST(ReadScenario, RefusesASensorOnALinkThatIsNotThere) {
  EXPECT_THAT(ScenarioFaults(WithRig(
                  "{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: bom}")),
              HasFault(kNoSuchName, "machines[0].rig.sensors[0].link"));
}

TEST(ReadScenario, RefusesASensorWithoutARate) {
  EXPECT_THAT(ScenarioFaults(WithRig("{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, "
                                     "link: boom, rate_hz: 0}")),
              HasFault(kOutOfRange, "rate_hz"));
}

TEST(ReadScenario, RefusesAnEncoderOnAJointThatIsNotThere) {
  EXPECT_THAT(ScenarioFaults(
                  WithRig("{name: e, preset: tera:config/sensors/encoder.yaml, joints: [elbow]}")),
              HasFault(kNoSuchName, "joints"));
}

TEST(ReadScenario, RefusesAMachineFileThatIsNotThere) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator, {"machines[0].machine=nowhere.yaml"}),
              HasFault(kUnreadable));
}

TEST(ReadScenario, RefusesCellsWiderThanAShoeOnGroundThatYields) {
  const std::string site = std::string(kSite) + kExcavator;  // tracks of 0.30 m
  EXPECT_THAT(ScenarioFaults(site, {"terrain.cell_m=0.35"}), HasFault(kOutOfRange, "cell_m"));
  EXPECT_THAT(ScenarioFaults(site, {"terrain.cell_m=0.3"}), testing::IsEmpty());
  EXPECT_THAT(ScenarioFaults(site, {"terrain.cell_m=0.35", "terrain.soil=asphalt"}),
              testing::IsEmpty());
}

TEST(ReadScenario, RefusesANegativeMassInTheMachineFile) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator,
                             {"machines[0].machine.links.boom.mass_kg=-3"}),
              HasFault(kOutOfRange, "machines[0].machine.links.boom.mass_kg"));
}

TEST(ReadScenario, RefusesAMissingMesh) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator +
                             "obstacles: [{name: r, label: rock, mesh: no.glb, xy_m: [1, 1]}]\n"),
              HasFault(kUnreadable, "obstacles[0].mesh"));
}

TEST(ReadScenario, RefusesABedWithoutAFloorOrWithWallsThatGoDown) {
  const auto faults = [](const std::string& bed) {
    return ScenarioFaults(
        std::string(kSite) + kExcavator +
        "obstacles: [{name: bin, label: structure, mesh: tera:assets/container.glb, "
        "xy_m: [1, 1], bed: " +
        bed + "}]\n");
  };
  EXPECT_THAT(faults("{xyz_m: [0, 0, 1], size_m: [3, 2], wall_m: 0.5}"), testing::IsEmpty());
  EXPECT_THAT(faults("{xyz_m: [0, 0, 1], size_m: [3, 0], wall_m: 0.5}"),
              HasFaultAt("obstacles[0].bed.size_m"));
  EXPECT_THAT(faults("{xyz_m: [0, 0, 1], size_m: [3, 2], wall_m: -0.5}"),
              HasFault(kOutOfRange, "obstacles[0].bed.wall_m"));
  EXPECT_THAT(faults("{size_m: [3, 2], wall_m: 0.5, walls_m: 1}"),
              AllOf(HasFaultAt("obstacles[0].bed.xyz_m"), HasFault(kUnknown, "walls_m")));
}

TEST(ReadScenario, RefusesTipsWithoutABedOfTooMuchOrThatGoBackInTime) {
  const auto faults = [](const std::string& rest) {
    return ScenarioFaults(std::string(kSite) + kExcavator +
                          "obstacles: [{name: bin, label: structure, mesh: "
                          "tera:assets/container.glb, xy_m: [1, 1], " +
                          rest + "}]\n");
  };
  const std::string bed = "bed: {xyz_m: [0, 0, 1], size_m: [3, 2], wall_m: 0.5}, ";
  const std::string rises = "{t_s: 0, angle_deg: 0}, {t_s: 9, angle_deg: 50}";
  EXPECT_THAT(faults(bed + "tips: [" + rises + "]"), testing::IsEmpty());
  EXPECT_THAT(faults("tips: [" + rises + "]"), HasFault(kInconsistent, "obstacles[0].tips"));
  EXPECT_THAT(faults(bed + "tips: [{t_s: 0, angle_deg: 100}]"),
              HasFault(kOutOfRange, "obstacles[0].tips[0].angle_deg"));
  EXPECT_THAT(faults(bed + "tips: [" + rises + ", {t_s: 8, angle_deg: 0}]"),
              HasFaultAt("obstacles[0].tips[2].t_s"));
}

TEST(ReadScenario, RefusesAnUnreadableGeoTiff) {
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator, {"terrain.geotiff=LICENSE"}),
              HasFaultAt("terrain.geotiff"));
}

TEST(ReadScenario, RefusesNamesThatAreUsedTwiceOrAreNoFolders) {
  const std::string cone = ", label: cone, mesh: tera:assets/cone.glb, xy_m: [1, 1]}";
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator + "obstacles: [{name: excavator1" +
                             cone + ", {name: a/b" + cone + "]\n"),
              HasFault(kMalformed, "obstacles[1].name"));
}

TEST(ReadScenario, RefusesMachineNamesThatLeaveTheDataset) {
  for (const char* name : {"..", ".", "''", "a b", "a,b", "/tmp/a"}) {
    EXPECT_THAT(
        ScenarioFaults(std::string(kSite) + kExcavator, {std::string("machines[0].name=") + name}),
        HasFaultAt("--set: machines[0].name"))
        << name;
  }
  EXPECT_THAT(ScenarioFaults(std::string(kSite) + kExcavator, {"machines[0].name=truth"}),
              HasFault(kInconsistent));
}

TEST(ReadScenario, RefusesStartAnglesBeyondTheLimits) {
  EXPECT_THAT(
      ScenarioFaults(std::string(kSite) + kExcavator,
                     {"machines[0].start.joints_deg={boom: 100, elbow: 3}"}),
      AllOf(HasFault(kOutOfRange, "start.joints_deg"), HasFault(kNoSuchName, "start.joints_deg")));
}

TEST(ReadScenario, JointsThatSlideStartByMetres) {
  const std::string axis =
      std::string(kSite) +
      "machines:\n  - name: axis\n    machine: tera:config/machines/emps.yaml\n"
      "    operator: {type: idle}\n";
  const Config config =
      Config::FromText(axis, "s.yaml", {"machines[0].start.joints_m.carriage=-0.2"});
  const Scenario scenario = ReadScenario(config.root());
  EXPECT_EQ(scenario.machines[0].placement.q_rad, std::vector<double>{-0.2});
  EXPECT_THAT(ScenarioFaults(axis, {"machines[0].start.joints_m.carriage=0.6"}),
              HasFault(kOutOfRange, "start.joints_m"));
  EXPECT_THAT(ScenarioFaults(axis, {"machines[0].start.joints_deg.carriage=10"}),
              HasFault(kInconsistent, "start.joints_deg"));
  EXPECT_THAT(
      ScenarioFaults(std::string(kSite) + kExcavator, {"machines[0].start.joints_m.boom=1"}),
      HasFault(kInconsistent, "start.joints_m"));
  EXPECT_THAT(ScenarioFaults(axis, {"machines[0].start.joints_m.carriage=ten"}),
              HasOnlyFault(kMistyped, "start.joints_m.carriage"));
}

TEST(ReadScenario, RefusesASiteWithoutMachines) {
  EXPECT_THAT(ScenarioFaults(kSite), HasFault(kMissing, "machines"));
}

TEST(ReadScenario, SetsAMachineOnASlope) {
  const Config config = Config::FromText(std::string(kSite) + kExcavator, "s.yaml",
                                         {"terrain.relief={slope_deg: 10, slope_direction_deg: 0}",
                                          "machines[0].start={yaw_deg: 90}"});
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  const TerrainSurface& ground = scenario.site->surface();
  const Pose& X_WB = scenario.machines[0].placement.X_WB;
  EXPECT_NEAR(std::acos(X_WB.linear().col(2).dot(ground.NormalAt(0, 0))), 0.0, 0.5 * kDeg);
  EXPECT_NEAR(std::acos(X_WB.linear()(2, 2)), 10 * kDeg, 0.5 * kDeg);
}

TEST(ReadScenario, ResolvedScenarioReadsTheSameAgain) {
  const Config config =
      Config::FromFile("config/scenarios/quickstart.yaml", {"terrain.cell_m=0.2"});
  ReadScenario(config.root());
  config.Finish();
  const std::string resolved = config.ResolvedYaml();
  const Config again = Config::FromText(resolved, "resolved.yaml");
  const Scenario scenario = ReadScenario(again.root());
  again.Finish();
  EXPECT_EQ(again.ResolvedYaml(), resolved);
  EXPECT_EQ(scenario.machines[0].sensors.size(), 11u);
}

TEST(Scenarios, AllThatAreShippedAreValid) {
  for (const char* name : {"quickstart", "drive_three_soils", "load_truck", "trench",
                           "two_machines", "warthog_asphalt"}) {
    const Config config = Config::FromFile(std::string("config/scenarios/") + name + ".yaml",
                                           {"terrain.cell_m=0.25"});
    ReadScenario(config.root());
    EXPECT_NO_THROW(config.Finish()) << name;
  }
}

TEST(ObstacleAt, FollowsItsPathOverTheGround) {
  // A plane that rises 0.1 m per metre along x.
  const TerrainSurface ground(
      TerrainGrid{.origin_W_m = Vec2(-10, -10), .cell_m = 20, .nx = 2, .ny = 2}, 1, {-1, 1, -1, 1},
      {{}});
  ScenarioObstacle walker;
  walker.height_above_ground_m = 0.5;
  walker.path = {{2, Vec2(0, 0)}, {4, Vec2(0, 3)}, {5, Vec2(4, 3)}};
  const BodyState middle = ObstacleAt(walker, FromSeconds(3), ground);
  EXPECT_TRUE(middle.X_WB.translation().isApprox(Vec3(0, 1.5, 0.5), 1e-6));
  EXPECT_NEAR(middle.v_WB_mps.y(), 1.5, 1e-9);
  EXPECT_NEAR(RpyFromRotation(middle.X_WB.linear()).z(), 90 * kDeg, 1e-9);
  const BodyState after = ObstacleAt(walker, FromSeconds(60), ground);
  EXPECT_TRUE(after.X_WB.translation().isApprox(Vec3(4, 3, 0.9), 1e-6));
  EXPECT_EQ(after.v_WB_mps.norm(), 0.0);
}

}  // namespace
}  // namespace tera
