#include "sim/scene_assembly.h"

#include <gtest/gtest.h>

#include <map>

#include "core/config/config.h"
#include "core/units.h"
#include "sim/simulation.h"

namespace tera {
namespace {

Scenario Read(const std::vector<std::string>& overrides = {}) {
  const Config config = Config::FromText(R"(
name: test
duration_s: 1
terrain: {size_m: [12, 12], cell_m: 0.2, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [1, 2], yaw_deg: 90}
    operator: {type: idle}
obstacles: [{name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [4, 1], yaw_deg: 30}]
)",
                                         "s.yaml", overrides);
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

TEST(SceneAssembly, EveryInstanceHasAFiniteBoxThatHoldsSomething) {
  const Scenario scenario = Read();
  const SceneAssembly assembly(scenario);
  const SceneModel& model = assembly.model();
  ASSERT_GT(model.instances.size(), 10u);
  for (std::size_t i = 1; i < model.instances.size(); ++i) {
    if (model.instances[i].is_whole) continue;
    const Vec3 size_m = model.instances[i].box_max_B_m - model.instances[i].box_min_B_m;
    EXPECT_TRUE(size_m.allFinite() && size_m.minCoeff() > 0.01) << model.instances[i].name;
    EXPECT_LT(size_m.maxCoeff(), 8.0) << model.instances[i].name;
  }
}

TEST(SceneAssembly, AMachineIsOneObjectWithItsTracksApartAndWithoutItsLoad) {
  const Scenario scenario = Read();
  const SceneAssembly assembly(scenario);
  const std::vector<SceneInstance>& instances = assembly.model().instances;
  const SceneInstance& whole = instances.back();
  EXPECT_EQ(whole.name, "excavator1");
  EXPECT_EQ(whole.label, SemanticClass::kVehicle);
  EXPECT_TRUE(whole.is_whole);
  EXPECT_EQ(whole.body, 0);
  std::map<std::string, std::uint16_t> parent;
  for (std::size_t i = 1; i + 1 < instances.size(); ++i) {
    EXPECT_FALSE(instances[i].is_whole);
    EXPECT_TRUE(parent.emplace(instances[i].name, instances[i].parent).second);
  }
  const auto id = static_cast<std::uint16_t>(instances.size() - 1);
  for (const char* part :
       {"undercarriage", "upper", "boom", "arm", "bucket", "left_track", "right_track"}) {
    EXPECT_EQ(parent.at(std::string("excavator1/") + part), id) << part;
  }
  EXPECT_EQ(parent.at("excavator1/bucket_soil"), 0);
  EXPECT_EQ(parent.at("cone1"), 0);
}

TEST(SceneAssembly, CylindersReachFromPinToPin) {
  Scenario scenario = Read();
  Simulation simulation(scenario);
  const SceneAssembly assembly(scenario);
  const std::vector<Pose> poses = assembly.BodyPoses(simulation.state());
  const MachineModel& machine = scenario.machines[0].placement.model;
  const auto& links = simulation.state().machines[0].links;
  const std::size_t linkages = machine.links.size() + machine.track_visuals[0].shoe_count +
                               machine.track_visuals[1].shoe_count;
  const std::size_t cylinders = linkages + 2 * machine.linkages.size();
  ASSERT_EQ(machine.linkages.size(), 1u);
  const Pose& X_WRocker = poses[linkages];
  for (std::size_t c = 0; c < machine.cylinders.size(); ++c) {
    const Cylinder& cylinder = machine.cylinders[c];
    const Pose& X_WRodLink = cylinder.linkage < 0 ? links[cylinder.rod_link].X_WB : X_WRocker;
    const Vec3 a_W = links[cylinder.barrel_link].X_WB * cylinder.barrel_pin_m;
    const Vec3 b_W = X_WRodLink * cylinder.rod_pin_m;
    const Pose& X_WBarrel = poses[cylinders + 2 * c];
    const Pose& X_WRod = poses[cylinders + 2 * c + 1];
    EXPECT_TRUE(X_WBarrel.translation().isApprox(a_W, 1e-9));
    EXPECT_TRUE(X_WRod.translation().isApprox(b_W, 1e-9));
    // The barrel's x axis passes through the rod's pin.
    const Vec3 b_Barrel = X_WBarrel.inverse() * b_W;
    EXPECT_NEAR(b_Barrel.x(), (b_W - a_W).norm(), 1e-9);
    EXPECT_NEAR(b_Barrel.tail<2>().norm(), 0.0, 1e-9);
  }
}

TEST(SceneAssembly, PinsOfTheBucketsFourBarStayTogetherOverItsTravel) {
  Scenario scenario = Read();
  Simulation simulation(scenario);
  const SceneAssembly assembly(scenario);
  const MachineModel& machine = scenario.machines[0].placement.model;
  const std::size_t rocker = machine.links.size() + machine.track_visuals[0].shoe_count +
                             machine.track_visuals[1].shoe_count;
  const std::size_t bucket_rod = rocker + 2 + 2 * 2 + 1;
  const int arm = machine.LinkIndex("arm"), bucket = machine.LinkIndex("bucket");
  Instant state = simulation.state();
  MachineState& now = state.machines[0];
  // The bucket's range, both ends included.
  for (int i = 0; i <= 100; ++i) {
    now.q_rad[machine.JointIndex("bucket")] = -1.222 + (0.873 + 1.222) * i / 100;
    const auto links =
        ForwardKinematics(machine, MakePose(Vec3(3, -2, 1), 0.1, -0.2, 2), now.q_rad);
    for (std::size_t l = 0; l < links.size(); ++l) now.links[l].X_WB = links[l];
    const std::vector<Pose> poses = assembly.BodyPoses(state);
    const Pose &X_WRocker = poses[rocker], &X_WCoupler = poses[rocker + 1];
    const Vec3 knee_W = X_WRocker * Vec3(0.29, 0, 0);
    EXPECT_LT((X_WRocker.translation() - links[arm] * Vec3(1.30, 0, 0.02)).norm(), 1e-4);
    EXPECT_LT((X_WCoupler.translation() - links[bucket] * Vec3(-0.125, 0, 0.165)).norm(), 1e-4);
    EXPECT_LT((X_WCoupler * Vec3(0.30, 0, 0) - knee_W).norm(), 1e-4);
    EXPECT_LT((poses[bucket_rod].translation() - knee_W).norm(), 1e-4);
  }
}

TEST(SceneAssembly, ShoesAdvanceBackwardsAlongTheGroundWhenDrivingForward) {
  Scenario scenario = Read();
  Simulation simulation(scenario);
  const SceneAssembly assembly(scenario);
  Instant state = simulation.state();
  const std::vector<Pose> before = assembly.BodyPoses(state);
  const MachineModel& machine = scenario.machines[0].placement.model;
  state.machines[0].gear_angle_rad[0] += 0.1;
  const std::vector<Pose> after = assembly.BodyPoses(state);
  const Pose& X_WB = state.machines[0].links[0].X_WB;
  int on_ground = 0;
  for (int k = 0; k < machine.track_visuals[0].shoe_count; ++k) {
    const Vec3 p = X_WB.inverse() * before[machine.links.size() + k].translation();
    const Vec3 q = X_WB.inverse() * after[machine.links.size() + k].translation();
    if (p.z() > 0.02 || std::abs(p.x()) > 0.6) continue;
    ++on_ground;
    EXPECT_NEAR(q.x() - p.x(), -0.1 * machine.ground_tools.gears[0].drive_radius_m, 1e-6);
    EXPECT_NEAR(p.y(), 0.574, 1e-6);
  }
  EXPECT_GT(on_ground, 8);
}

TEST(SceneAssembly, SoilInABucketIsThereWhenSomethingIsCarried) {
  Scenario scenario = Read();
  Simulation simulation(scenario);
  const SceneAssembly assembly(scenario);
  Instant state = simulation.state();
  ASSERT_EQ(assembly.model().shape_count, 1);
  EXPECT_EQ(assembly.ShapesOf(state), Shapes{nullptr});
  state.machines[0].shovel_load[0].volume_m3 = 0.05;
  const Shapes shapes = assembly.ShapesOf(state);
  ASSERT_EQ(shapes.size(), 1u);
  ASSERT_NE(shapes[0], nullptr);
  // Its body is the bucket, so that it lies at the shell.
  const SceneModel& model = assembly.model();
  const auto soil = std::find_if(model.nodes.begin(), model.nodes.end(),
                                 [](const SceneNode& n) { return n.shape == 0; });
  const int bucket = scenario.machines[0].placement.model.LinkIndex("bucket");
  const Pose& X_WB = state.machines[0].links[bucket].X_WB;
  EXPECT_TRUE(assembly.BodyPoses(state)[soil->body].isApprox(X_WB, 1e-12));
}

TEST(SceneAssembly, ShoesAreShownAtTheirScale) {
  const auto shoe_scale = [](const std::vector<std::string>& overrides) {
    const Scenario scenario = Read(overrides);
    const SceneAssembly assembly(scenario);
    const auto& model = assembly.model();
    const auto shoe = std::find_if(model.nodes.begin(), model.nodes.end(), [&](const SceneNode& n) {
      return model.meshes[n.mesh].name.ends_with("#shoe");
    });
    return shoe->scale;
  };
  EXPECT_EQ(shoe_scale({}), 1.0);
  EXPECT_EQ(shoe_scale({"machines[0].machine.tracks.left_track.shoe.scale=1.5"}), 1.5);
}

}  // namespace
}  // namespace tera
