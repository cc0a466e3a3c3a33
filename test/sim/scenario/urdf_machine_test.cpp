#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/units.h"
#include "own_folder.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

// A backhoe loader of 23 links, with every element of URDF, from its file to a run.

namespace tera {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const fs::path kData = "test/sim/data";

Scenario ReadUrdfScenario(const fs::path& machine = kData / "backhoe_loader.yaml") {
  const Config config = Config::FromText(R"(
name: test
duration_s: 1
terrain: {size_m: [24, 24], cell_m: 0.2, soil: gravel}
machines:
  - name: loader1
    machine: )" + machine.string() + R"(
    start: {xy_m: [1, -2], yaw_deg: 50}
    operator: {type: idle}
)",
                                         "s.yaml");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

const MachineModel& ModelOf(const Scenario& scenario) {
  return scenario.machines[0].placement.model;
}

const Link& LinkOf(const Scenario& scenario, const std::string& name) {
  return ModelOf(scenario).links.at(ModelOf(scenario).LinkIndex(name));
}

TEST(UrdfMachine, HasTheLeversOfItsDrivesInTheirOrder) {
  const Scenario scenario = ReadUrdfScenario();
  EXPECT_EQ(ModelOf(scenario).links.size(), 23u);
  std::vector<std::string> levers;
  for (const Lever& lever : ModelOf(scenario).levers) levers.push_back(lever.name);
  EXPECT_THAT(levers,
              ElementsAre("loader_lift", "loader_tilt", "swing", "boom", "dipper", "curl", "extend",
                          "side_shift", "stabiliser_left_slide", "stabiliser_right_slide"));
}

TEST(UrdfMachine, WhatIsNotReadIsCounted) {
  EXPECT_THAT(ModelOf(ReadUrdfScenario()).remarks,
              ElementsAre("backhoe_loader.urdf: 1 texture, 1 safety controller left out"));
}

Vec3 ShownSize_m(const SceneModel& scene, const std::string& name) {
  for (const SceneInstance& instance : scene.instances) {
    if (instance.name == name) return instance.box_max_B_m - instance.box_min_B_m;
  }
  ADD_FAILURE() << name;
  return Vec3::Zero();
}

/// Meshes shown at a link.
std::vector<const Mesh*> Shown(const SceneModel& scene, const std::string& name) {
  std::vector<const Mesh*> meshes;
  for (const SceneNode& node : scene.nodes) {
    if (scene.instances[node.instance].name == name) meshes.push_back(&scene.meshes[node.mesh]);
  }
  return meshes;
}

TEST(UrdfMachine, ShowsBoxesBallsCylindersAndMeshesAsLargeAsTheyAre) {
  const Scenario scenario = ReadUrdfScenario();
  const SceneAssembly assembly(scenario);
  const SceneModel& scene = assembly.model();
  // A tyre of 0.9 m about its axle along y, its rim 2 cm wider.
  EXPECT_TRUE(ShownSize_m(scene, "loader1/wheel_front_left").isApprox(Vec3(0.9, 0.37, 0.9), 1e-5));
  EXPECT_TRUE(ShownSize_m(scene, "loader1/beacon").isApprox(Vec3::Constant(0.16), 1e-5));
  // wedge.stl is 700 x 2000 x 600, scaled by 1.1 mm.
  EXPECT_TRUE(ShownSize_m(scene, "loader1/loader_bucket").isApprox(Vec3(0.77, 2.2, 0.66), 1e-5));
  // The chassis from its counterweight's side (x = 1.7 m) to the bar at -1.8 m, 2.2 m wide.
  EXPECT_TRUE(ShownSize_m(scene, "loader1/chassis").isApprox(Vec3(3.5, 2.2, 0.925), 1e-5));
  EXPECT_EQ(Shown(scene, "loader1/antenna_left").size(), 0u);
}

TEST(UrdfMachine, SolidsAndStlFilesHaveTheColourOfTheirMaterial) {
  const Scenario scenario = ReadUrdfScenario();
  const SceneAssembly assembly(scenario);
  const auto material = [&](const std::string& link, std::size_t which) -> const Material& {
    return Shown(assembly.model(), link).at(which)->parts.at(0).material;
  };
  // The sRGB value 0.5 is the linear one 0.2140 (IEC 61966-2-1), 0.08 is 0.0072.
  EXPECT_NEAR(material("loader1/loader_bucket", 0).albedo.x(), 0.2140, 1e-4);
  EXPECT_NEAR(material("loader1/wheel_rear_left", 0).albedo.y(), 0.0072, 2e-5);
  EXPECT_NEAR(material("loader1/door", 0).opacity, 0.3, 1e-6);
  const Material plain;  // a solid without a colour: the bar, which has only a texture
  EXPECT_EQ(material("loader1/chassis", 2).albedo, plain.albedo);
  EXPECT_NE(material("loader1/chassis", 0).albedo, plain.albedo);
}

TEST(UrdfMachine, CollisionMeshesAreTheBoxesAroundThem) {
  const Scenario scenario = ReadUrdfScenario();
  const Link& bucket = LinkOf(scenario, "loader_bucket");
  ASSERT_EQ(bucket.collision.size(), 1u);
  EXPECT_TRUE(bucket.collision[0].size_m.isApprox(Vec3(0.7, 2.2, 0.6), 1e-6));
  EXPECT_TRUE(bucket.collision[0].X_BG.translation().isApprox(Vec3(0.35, 0, 0.3), 1e-6));
  const Link& cab = LinkOf(scenario, "cab");
  ASSERT_EQ(cab.collision.size(), 2u);
  EXPECT_TRUE(cab.collision[1].size_m.isApprox(Vec3(1.3, 1.2, 0.13), 1e-6));
  EXPECT_NEAR(cab.collision[1].X_BG.translation().z(), 1.5 + 0.065, 1e-6);
  for (const Link& link : ModelOf(scenario).links) EXPECT_TRUE(link.collision_meshes.empty());
}

/// Every lever permanently at `lever`.
class Constant : public Operator {
 public:
  explicit Constant(double lever) : lever_(lever) {}
  std::vector<double> Levers(const OperatorView& view) override {
    return std::vector<double>(view.model.levers.size(), lever_);
  }

 private:
  double lever_;
};

TEST(UrdfMachine, MovesByItsLeversWithinItsLimits) {
  Scenario scenario = ReadUrdfScenario();
  Operators operators;
  operators.push_back(std::make_unique<Constant>(0.5));
  Simulation simulation(scenario, std::move(operators));
  const MachineModel& model = ModelOf(scenario);
  const std::vector<double> before_rad = simulation.state().machines[0].q_rad;
  for (int i = 0; i < 500; ++i) {
    simulation.Step();
    const MachineState& now = simulation.state().machines[0];
    for (const BodyState& link : now.links) ASSERT_TRUE(link.X_WB.matrix().allFinite());
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const Joint& joint = model.joints[j];
      ASSERT_TRUE(std::isfinite(now.q_rad[j]) && std::isfinite(now.effort_nm[j])) << joint.name;
      if (joint.type == JointType::kFixed || joint.type == JointType::kContinuous) continue;
      ASSERT_GE(now.q_rad[j], joint.lower_rad - 1e-3) << joint.name;
      ASSERT_LE(now.q_rad[j], joint.upper_rad + 1e-3) << joint.name;
    }
  }
  // Half the rate of <limit velocity> for a second, except `extend`, whose command interface allows
  // 0.25 m/s. No joint reaches its stop.
  const std::vector<std::pair<std::string, double>> moved = {{"loader_lift", 0.3},
                                                             {"loader_tilt", 0.45},
                                                             {"swing", 0.35},
                                                             {"boom", 0.25},
                                                             {"dipper", 0.4},
                                                             {"curl", 0.6},
                                                             {"extend", 0.125},
                                                             {"side_shift", 0.075},
                                                             {"stabiliser_left_slide", 0.125},
                                                             {"stabiliser_right_slide", 0.125}};
  for (const auto& [name, expected] : moved) {
    const int joint = model.JointIndex(name);
    EXPECT_NEAR(simulation.state().machines[0].q_rad[joint] - before_rad[joint], expected,
                0.02 * expected)
        << name;
  }
  // It stays on its tyres.
  const Pose& X_WB = simulation.state().machines[0].links[0].X_WB;
  EXPECT_GT(X_WB.linear()(2, 2), std::cos(3 * kDeg));
  EXPECT_NEAR(X_WB.translation().z(), 0, 0.1);
}

/// The message about the machine with one passage of its URDF replaced.
std::string FaultsWith(const std::string& passage, const std::string& by) {
  const fs::path folder = OwnFolder() / "urdf";
  fs::remove_all(folder);
  fs::copy(kData, folder);
  std::ifstream in(kData / "backhoe_loader.urdf");
  std::stringstream read;
  read << in.rdbuf();
  std::string text = read.str();
  const std::size_t at = text.find(passage);
  EXPECT_NE(at, std::string::npos) << passage;
  text.replace(at, passage.size(), by);
  std::ofstream(folder / "backhoe_loader.urdf") << text;
  try {
    ReadUrdfScenario(folder / "backhoe_loader.yaml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

int LinesIn(const std::string& text) {
  return text.empty() ? 0 : 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

TEST(UrdfMachine, AMissingCollisionMeshIsToldWithItsLine) {
  const std::string faults =
      FaultsWith(R"(<collision><origin xyz="0 0 1.5"/><geometry><mesh filename="canopy.obj"/>)",
                 R"(<collision><origin xyz="0 0 1.5"/><geometry><mesh filename="canop.obj"/>)");
  EXPECT_THAT(faults,
              AllOf(HasSubstr("backhoe_loader.yaml:3:7: machines[0].machine.urdf: link 'cab' of "
                              "backhoe_loader.urdf:"),
                    HasSubstr("collision: mesh 'canop.obj' does not exist; correct the path")));
  EXPECT_EQ(LinesIn(faults), 1) << faults;
}

TEST(UrdfMachine, AMeshThatCannotBeReadIsTold) {
  const std::string faults =
      FaultsWith(R"(<collision><origin xyz="0 0 1.5"/><geometry><mesh filename="canopy.obj"/>)",
                 R"(<collision><geometry><mesh filename="backhoe_loader.yaml"/>)");
  EXPECT_THAT(faults, AllOf(HasSubstr("collision: "), HasSubstr("not a readable mesh")));
  EXPECT_EQ(LinesIn(faults), 1) << faults;
}

TEST(UrdfMachine, ASolidWithoutASizeIsTold) {
  EXPECT_THAT(FaultsWith(R"(<sphere radius="0.08"/>)", R"(<sphere radius="0"/>)"),
              HasSubstr("visual: a solid of 0 x 0 x 0 m; need sizes above 0"));
}

TEST(UrdfMachine, MirroredMeshesAreShownMirrored) {
  const fs::path folder = OwnFolder();
  // A corner whose edges along x, y, z are 1, 2 and 3 long.
  std::ofstream(folder / "corner.obj") << "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n"
                                          "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::string urdf = "<robot name='r'><link name='root'/>";
  const std::vector<Vec3> scales = {{1, -1, 1},  {-0.5, 0.5, 0.5}, {1, 1, -1}, {-1, -1, 1},
                                    {2, -2, -2}, {-1, -1, -1},     {1, 1, 1}};
  for (std::size_t i = 0; i < scales.size(); ++i) {
    std::stringstream scale;
    scale << scales[i].transpose();
    const std::string name = "l" + std::to_string(i);
    urdf += "<link name='" + name + "'><visual><origin xyz='1 0 0' rpy='0 0 1.5707963267948966'/>" +
            "<geometry><mesh filename='corner.obj' scale='" + scale.str() +
            "'/></geometry></visual></link><joint name='j" + name +
            "' type='fixed'><parent link='root'/><child link='" + name + "'/></joint>";
  }
  std::ofstream(folder / "corners.urdf") << urdf << "</robot>";
  std::ofstream(folder / "corners.yaml") << "kind: r\nfixed_base: true\nurdf: corners.urdf\n";
  const Scenario scenario = ReadUrdfScenario(folder / "corners.yaml");
  const SceneAssembly assembly(scenario);
  for (const SceneNode& node : assembly.model().nodes) {
    EXPECT_NEAR(node.X_BG.linear().determinant(), 1, 1e-9);  // a pose cannot mirror
  }
  for (const SceneInstance& instance : assembly.model().instances) {
    const std::size_t at = instance.name.find("/l");
    if (at == std::string::npos) continue;
    const Vec3 edges_m =
        scales[std::stoul(instance.name.substr(at + 2))].cwiseProduct(Vec3(1, 2, 3));
    // Turned left by 90 deg: x shows along y, y against x; moved by 1 m along x.
    const Vec3 far_m = Vec3(1 - edges_m.y(), edges_m.x(), edges_m.z()), near_m = Vec3(1, 0, 0);
    EXPECT_TRUE(instance.box_min_B_m.isApprox(far_m.cwiseMin(near_m), 1e-6)) << instance.name;
    EXPECT_TRUE(instance.box_max_B_m.isApprox(far_m.cwiseMax(near_m), 1e-6)) << instance.name;
  }
}

TEST(UrdfMachine, AMeshOfSeveralScalesIsTold) {
  EXPECT_THAT(FaultsWith("0.0011 0.0011 0.0011", "0.0011 -0.0011 0.001"),
              HasSubstr("visual: mesh 'wedge.stl' is scaled by 0.0011 -0.0011 0.001; need one"));
  EXPECT_THAT(FaultsWith("0.0011 0.0011 0.0011", "0 0 0"), HasSubstr("is scaled by 0 0 0"));
}

TEST(UrdfMachine, AJointThatMimicsNoneThatThereIsIsTold) {
  const std::string faults = FaultsWith(R"(<parent link="backhoe_boom"/>)",
                                        R"(<mimic joint="bom"/><parent link="backhoe_boom"/>)");
  EXPECT_THAT(faults, HasSubstr("mimic: there is no joint 'bom' (did you mean 'boom'?)"));
  EXPECT_EQ(LinesIn(faults), 1) << faults;
}

TEST(UrdfMachine, AFileThatIsNoXmlOrNoUrdfIsOneFault) {
  const std::string cut = FaultsWith("</robot>", "");
  EXPECT_THAT(cut, HasSubstr("is not valid XML"));
  EXPECT_EQ(LinesIn(cut), 1) << cut;
  const std::string crossed = FaultsWith(R"(<link name="door">)", R"(<link name="door"><visual>)");
  EXPECT_THAT(crossed, AllOf(HasSubstr("backhoe_loader.urdf:"), HasSubstr("is not valid XML")));
  EXPECT_EQ(LinesIn(crossed), 1) << crossed;
  const std::string unknown = FaultsWith(R"(<child link="door"/>)", R"(<child link="dor"/>)");
  EXPECT_THAT(unknown, HasSubstr("is not a valid URDF"));
  EXPECT_EQ(LinesIn(unknown), 1) << unknown;
}

}  // namespace
}  // namespace tera
