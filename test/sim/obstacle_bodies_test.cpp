#include "sim/obstacle_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/config/config.h"
#include "sim/scenario/scenario_text.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

// The walking worker: his boots stand on the ground without sliding, and his key points stay in his
// limbs.

namespace tera {
namespace {

Scenario Walker() {
  const Config config = Config::FromText(
      std::string(kSite) + kExcavator +
          "obstacles: [{name: p, preset: 'tera:config/obstacles/person_walking.yaml', xy_m: [4, 4],"
          " path: [{t_s: 0, xy_m: [-5, 4]}, {t_s: 8, xy_m: [5, 4]}]}]\n",
      "s.yaml", {});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

/// The scene of a walker at one time, with the bodies of his limbs by name.
struct Scene {
  explicit Scene(const Scenario& scenario) : scenario(scenario), assembly(scenario) {
    const auto& nodes = assembly.model().nodes;
    for (const SceneNode& node : nodes) {
      if (assembly.model().instances[node.instance].name == "p") own.push_back(&node);
    }
  }
  std::vector<Pose> At(double t_s) const {
    const ScenarioObstacle& person = scenario.obstacles[0];
    const TimeNs t_ns = FromSeconds(t_s);
    std::vector<Pose> poses;
    AppendObstaclePoses(person, ObstacleAt(person, t_ns, scenario.site->surface()).X_WB, t_ns,
                        &poses);
    return poses;
  }
  /// Corners of a node's mesh, the trunk's 0, in W.
  std::vector<Vec3> Corners(std::size_t k, double t_s) const {
    std::vector<Vec3> corners;
    const Pose X_WB = At(t_s)[k];
    for (const MeshPart& part : assembly.model().meshes[own[k]->mesh].parts) {
      for (const Eigen::Vector3f& p : part.positions_m) corners.push_back(X_WB * p.cast<double>());
    }
    return corners;
  }
  std::size_t Limb(const std::string& name) const {
    const auto& limbs = scenario.obstacles[0].gait.limbs;
    return 1 + (std::ranges::find(limbs, name, &ObstacleLimb::name) - limbs.begin());
  }

  const Scenario& scenario;
  SceneAssembly assembly;
  std::vector<const SceneNode*> own;  ///< trunk, then limbs
};

double Lowest(const std::vector<Vec3>& corners) {
  double lowest_m = 1e9;
  for (const Vec3& p : corners) lowest_m = std::min(lowest_m, p.z());
  return lowest_m;
}

TEST(ObstacleBodies, OneBootOfAWalkerStandsOnTheGroundAtAnyTime) {
  const Scenario scenario = Walker();
  const Scene scene(scenario);
  ASSERT_EQ(scene.own.size(), 11u);
  const double ground_m = scenario.site->surface().HeightAt(0, 4);
  for (double t_s = 0; t_s < 4; t_s += 0.037) {
    const double left_m = Lowest(scene.Corners(scene.Limb("left_boot"), t_s));
    const double right_m = Lowest(scene.Corners(scene.Limb("right_boot"), t_s));
    EXPECT_NEAR(std::min(left_m, right_m), ground_m, 0.02) << t_s;
  }
}

TEST(ObstacleBodies, TheBootThatStandsKeepsItsPlaceWhileTheBodyGoesOn) {
  const Scenario scenario = Walker();
  const Scene scene(scenario);
  // 1.25 m/s and a stride of 1.41 m. While the left leg moves from front to back, its ankle stays
  // within 0.12 m of its foothold; the body moves by 0.6 m.
  const Vec3 ankle(0, 0.095, 0.08);
  const double stride_s = scenario.obstacles[0].gait.stride_m / 1.25;
  const std::size_t boot = scene.Limb("left_boot");
  const Vec3 put_down = scene.At(stride_s)[boot] * ankle;
  for (double share = 0; share < 0.42; share += 0.05) {
    const Vec3 now = scene.At((1 + share) * stride_s)[boot] * ankle;
    EXPECT_NEAR(now.x(), put_down.x(), 0.12) << share;
  }
  const double gone_m =
      scene.At(1.42 * stride_s)[0].translation().x() - scene.At(stride_s)[0].translation().x();
  EXPECT_NEAR(gone_m, 0.593, 0.01);
}

TEST(ObstacleBodies, TheBoxOfAWalkerHoldsHimAtAnyTime) {
  const Scenario scenario = Walker();
  const Scene scene(scenario);
  const SceneInstance& person = scene.assembly.model().instances[scene.own[0]->instance];
  for (double t_s = 0; t_s < 2; t_s += 0.061) {
    const Pose X_BW = scene.At(t_s)[0].inverse();
    for (std::size_t k = 0; k < scene.own.size(); ++k) {
      for (const Vec3& p_W : scene.Corners(k, t_s)) {
        const Vec3 p_B = X_BW * p_W;
        ASSERT_TRUE((p_B.array() > person.box_min_B_m.array() - 0.01).all() &&
                    (p_B.array() < person.box_max_B_m.array() + 0.01).all())
            << t_s << ", body " << k;
      }
    }
  }
}

TEST(ObstacleBodies, KeyPointsMoveWithTheLimbs) {
  const Scenario scenario = Walker();
  const Scene scene(scenario);
  const auto& keypoints = scene.assembly.model().keypoints;
  const auto wrist = std::ranges::find(keypoints, std::string("left_wrist"), &SceneKeypoint::name);
  ASSERT_NE(wrist, keypoints.end());
  const int first_body = scene.own[0]->body;
  EXPECT_EQ(static_cast<std::size_t>(wrist->body - first_body), scene.Limb("left_forearm"));
  double least_m = 1e9, most_m = -1e9;
  for (double t_s = 0; t_s < 1.2; t_s += 0.05) {
    const std::vector<Pose> poses = scene.At(t_s);
    const Vec3 p_B_m = poses[0].inverse() * (poses[wrist->body - first_body] * wrist->p_B_m);
    least_m = std::min(least_m, p_B_m.x());
    most_m = std::max(most_m, p_B_m.x());
  }
  EXPECT_GT(most_m - least_m, 0.35) << "it swings from behind the body to before it";
}

}  // namespace
}  // namespace tera
