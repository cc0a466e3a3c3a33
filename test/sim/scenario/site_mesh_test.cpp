#include "sim/scenario/site_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <span>

#include "core/faults.h"
#include "core/units.h"
#include "own_folder.h"
#include "render/rays/ray_scene.h"
#include "sim/scenario/scenario_text.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {
namespace {

using enum FaultKind;
using ::testing::AllOf;

/// A ramp z = 0.1 x + 0.5 over x and y of -8 to 8 m. From x = 4 on, a wall of 0.2 m stands on it,
/// up to z = 3.
const std::string kSiteObj = R"(
o ground
v -8 -8 -0.3
v 8 -8 1.3
v 8 8 1.3
v -8 8 -0.3
f 1 2 3
f 1 3 4
o wall
v 4 -3 0
v 4.2 -3 0
v 4.2 3 0
v 4 3 0
v 4 -3 3
v 4.2 -3 3
v 4.2 3 3
v 4 3 3
f 5 8 7 6
f 9 10 11 12
f 5 9 12 8
f 6 7 11 10
f 5 6 10 9
f 8 12 11 7
)";

class SiteMeshFile : public ::testing::Test {
 protected:
  void SetUp() override { Write("site.obj", kSiteObj); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  /// A scenario whose environment.mesh is the file with these keys.
  std::string Yaml(const std::string& keys, const std::string& terrain = "cell_m: 0.1, soil: dirt",
                   const std::string& file = "site.obj") const {
    return "name: test\nduration_s: 1\nsettle_s: 0\nterrain: {" + terrain +
           "}\nenvironment: {mesh: {file: " + (folder_ / file).string() + ", " + keys + "}}\n" +
           kExcavator;
  }
  Scenario Read(const std::string& yaml) const {
    const Config config = Config::FromText(yaml, "s.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return scenario;
  }

  const std::filesystem::path folder_ = OwnFolder();
};

const std::string kGroundAndWall =
    "ground: {node: ground, cell_m: 0.2}, parts: [{node: wall, label: barrier}]";

TEST_F(SiteMeshFile, TheTopOfItsNodeIsTheGround) {
  const Scenario scenario = Read(Yaml(kGroundAndWall));
  const TerrainSurface& ground = scenario.site->surface();
  EXPECT_NEAR((ground.nx - 1) * ground.cell_m, 16, 1e-6);
  for (const Vec2& p : {Vec2(0, 0), Vec2(4.1, 0.5), Vec2(-7.3, 6.1), Vec2(7.77, -5.2)}) {
    EXPECT_NEAR(ground.HeightAt(p.x(), p.y()), 0.1 * p.x() + 0.5, 1e-4) << p.transpose();
  }
  // The machine stands on the ramp, its nose up by atan 0.1.
  const Pose& X_WB = scenario.machines[0].placement.X_WB;
  EXPECT_NEAR(X_WB.translation().z(), 0.5, 0.01);
  EXPECT_NEAR(RpyFromRotation(X_WB.linear()).y(), -std::atan(0.1), 1e-3);
}

TEST_F(SiteMeshFile, IsMovedTurnedAndScaled) {
  // Rotated by 90 deg the ramp rises along y. At half size and 1 m higher, its slope stays 0.1.
  const Scenario scenario =
      Read(Yaml("xyz_m: [0.5, 0, 1], rpy_deg: [0, 0, 90], scale: 0.5, ground: {node: ground}",
                "size_m: [6, 6], cell_m: 0.1, soil: dirt"));
  const TerrainSurface& ground = scenario.site->surface();
  EXPECT_NEAR(ground.HeightAt(0, 0), 1.25, 1e-4);
  EXPECT_NEAR(ground.HeightAt(1, 2), 1.25 + 0.2, 1e-4);
}

TEST_F(SiteMeshFile, ItsWallIsMetByRaysAtItsFaceWithItsClass) {
  const Scenario scenario = Read(Yaml(kGroundAndWall));
  const Simulation simulation(scenario);
  const SceneAssembly assembly(scenario);
  RayScene rays(assembly.model());
  rays.Update({assembly.BodyPoses(simulation.state())}, simulation.ground());
  // From 2 m before the machine's nose to the wall's face at x = 4 m, and beyond it.
  const std::vector<Ray> asked = {{{3, 2.5f, 2}, {1, 0, 0}, 100, 0},
                                  {{3, 3.5f, 2.9f}, {1, 0, 0}, 100, 0},
                                  {{5, 0, 2}, {0, 0, -1}, 100, 0}};
  std::vector<RayHit> hits(asked.size());
  rays.Trace(asked, hits, 1);
  ASSERT_TRUE(hits[0].hit);
  EXPECT_NEAR(hits[0].range_m, 1.0, 1e-4);
  EXPECT_EQ(hits[0].label, SemanticClass::kBarrier);
  EXPECT_EQ(assembly.model().instances[hits[0].instance].name, "wall");
  EXPECT_TRUE(!hits[1].hit || hits[1].label == SemanticClass::kTerrain);
  ASSERT_TRUE(hits[2].hit);  // the ramp below x = 5 m, 1 m high
  EXPECT_NEAR(hits[2].range_m, 1.0, 1e-3);
  EXPECT_EQ(hits[2].label, SemanticClass::kTerrain);
}

TEST_F(SiteMeshFile, OnlySolidPartsAreWallsForMachines) {
  EXPECT_EQ(Read(Yaml(kGroundAndWall)).site_mesh->Walls().indices.size(), 3u * 12u);
  const std::string open = "parts: [{node: wall, solid: false}]";
  EXPECT_TRUE(Read(Yaml(open)).site_mesh->Walls().empty());
  // Without parts and ground it is a single solid object: the ground's two triangles and the
  // wall's.
  const Scenario whole = Read(Yaml("scale: 1"));
  EXPECT_EQ(whole.site_mesh->Walls().indices.size(), 3u * 14u);
  EXPECT_EQ(whole.site_mesh->parts.at(0).name, "site");
  EXPECT_EQ(whole.site->surface().HeightAt(3, 0), 0);
}

/// Distance of a rover along x after some seconds at half speed, along level ground.
double DrivenFrom0_m(const std::string& environment) {
  const Config config = Config::FromText(
      "name: t\nduration_s: 1\nsettle_s: 0.5\n"
      "terrain: {size_m: [24, 12], cell_m: 0.1, soil: asphalt}\n" +
          environment +
          "machines:\n  - {name: r, machine: tera:config/machines/warthog.yaml, operator: {type: "
          "waypoints, waypoints: [{xy_m: [9, 0]}], speed_mps: 1.5}}\n",
      "s.yaml");
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  Simulation simulation(scenario);
  for (int i = 0; i < 3000; ++i) simulation.Step();
  return simulation.state().machines[0].links[0].X_WB.translation().x();
}

TEST_F(SiteMeshFile, ItsWallStopsAMachineThatDrivesAgainstIt) {
  const double stopped_m =
      DrivenFrom0_m("environment: {mesh: {file: " + (folder_ / "site.obj").string() +
                    ", parts: [{node: wall}]}}\n");
  EXPECT_GT(stopped_m, 2.5);
  EXPECT_LT(stopped_m, 3.6);  // its front reaches more than 0.4 m ahead of its middle
  EXPECT_GT(DrivenFrom0_m(""), 6);
}

TEST_F(SiteMeshFile, IsWrittenSoThatItReadsAgainTheSame) {
  const Config config = Config::FromText(Yaml(kGroundAndWall), "s.yaml");
  const Scenario first = ReadScenario(config.root());
  config.Finish();
  const Scenario again = Read(config.ResolvedYaml());
  EXPECT_EQ(again.site->surface().nx, first.site->surface().nx);
  EXPECT_EQ(again.site->surface().HeightAt(1.23, 2.5), first.site->surface().HeightAt(1.23, 2.5));
  EXPECT_EQ(again.site_mesh->parts.size(), 1u);
}

TEST_F(SiteMeshFile, FaultsSayWhereTheyAre) {
  EXPECT_THAT(ScenarioFaults(Yaml("parts: [{node: wal}]")),
              HasFault(kNoSuchName, "environment.mesh.parts[0].node"));
  EXPECT_THAT(ScenarioFaults(Yaml("parts: [{node: wall, label: barier}]")),
              HasFaultAt("environment.mesh.parts[0].label"));
  EXPECT_THAT(ScenarioFaults(Yaml("ground: {node: ground}, scale: -2")),
              HasFault(kOutOfRange, "environment.mesh.scale"));
  EXPECT_THAT(ScenarioFaults(Yaml("ground: {node: ground, cell_m: 0}")),
              HasFaultAt("environment.mesh.ground.cell_m"));
  EXPECT_THAT(ScenarioFaults(Yaml("ground: {node: ground}, gruond: 1")),
              HasFault(kUnknown, "gruond"));
  EXPECT_THAT(ScenarioFaults(Yaml("scale: 1", "cell_m: 0.1, soil: dirt", "no.obj")),
              HasFault(kUnreadable, "environment.mesh.file"));
  EXPECT_THAT(ScenarioFaults(Yaml("ground: {node: ground}", "size_m: [17, 16], soil: dirt")),
              HasFault(kInconsistent, "environment.mesh.ground"));
  EXPECT_THAT(ScenarioFaults(Yaml("ground: {node: ground}", "size_m: [1e12, 1e12], soil: dirt")),
              HasFault(kOutOfRange, "cell_m"));
  EXPECT_THAT(ScenarioFaults(Yaml("ground: {node: ground}", "size_m: [-4, 4], soil: dirt")),
              HasFaultAt("terrain.size_m"));
  EXPECT_THAT(ScenarioFaults(Yaml("ground: {node: ground}, xyz_m: [20, 0, 0]")),
              HasFault(kInconsistent));
  EXPECT_THAT(ScenarioFaults(Yaml("parts: [{node: wall, name: excavator1}]")), HasFault(kRepeated));
}

TEST_F(SiteMeshFile, AMissingPictureIsAFaultAtTheNodeThatNeedsIt) {
  const std::string head = "mtllib site.mtl\n", faces = "usemtl paint\n";
  Write("textured.obj", head + "o wall\nv 0 0 0\nv 1 0 0\nv 1 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n" +
                            faces + "f 1/1 2/2 3/3\n");
  Write("site.mtl", "newmtl paint\nmap_Kd bricks.png\n");
  const std::string yaml = Yaml("parts: [{node: wall}]", "cell_m: 0.1, soil: dirt", "textured.obj");
  EXPECT_THAT(ScenarioFaults(yaml),
              AllOf(HasFaultAt("environment.mesh.parts[0].node"), HasFault(kMalformed)));
  Write("bricks.png", "no picture");
  EXPECT_THAT(ScenarioFaults(yaml), HasFault(kMalformed));
}

}  // namespace
}  // namespace tera
