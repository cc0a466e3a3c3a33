#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "core/units.h"
#include "render/meshes/load_mesh.h"
#include "sim/scenario/scenario_text.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

// The shipped obstacles: each is readable, its boxes fit its mesh, and key points lie in bodies.

namespace tera {
namespace {

std::vector<std::string> Presets() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("config/obstacles")) {
    names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Scenario With(const std::string& obstacles) {
  const Config config =
      Config::FromText(std::string(kSite) + kExcavator + "obstacles: [" + obstacles + "]\n", "s");
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

ScenarioObstacle Obstacle(const std::string& preset) {
  return With("{name: o, preset: 'tera:config/obstacles/" + preset + ".yaml', xy_m: [4, 4]}")
      .obstacles.at(0);
}

/// Distance from a point to a triangle (Ericson 2005, Real-Time Collision Detection, 5.1.5).
double Distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const Vec3 foot = p - n * (p - a).dot(n) / std::max(n.squaredNorm(), 1e-30);
  const bool inside = n.dot((b - a).cross(foot - a)) >= 0 && n.dot((c - b).cross(foot - b)) >= 0 &&
                      n.dot((a - c).cross(foot - c)) >= 0;
  if (inside) return (p - foot).norm();
  const auto to_edge = [&](const Vec3& from, const Vec3& to) {
    const double s = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    return (p - from - s * (to - from)).norm();
  };
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

double DistanceTo(const Mesh& mesh, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const MeshPart& part : mesh.parts) {
    for (std::size_t t = 0; t < part.indices.size(); t += 3) {
      const auto at = [&](int k) -> Vec3 {
        return part.positions_m[part.indices[t + k]].cast<double>();
      };
      nearest = std::min(nearest, Distance(p, at(0), at(1), at(2)));
    }
  }
  return nearest;
}

/// The mesh of the obstacle's body, or of a limb of its gait.
Mesh MeshOf(const ScenarioObstacle& obstacle, int limb) {
  const Visual& visual = limb < 0 ? obstacle.visual : obstacle.gait.limbs[limb].visual;
  return LoadMesh(visual.mesh, visual.node);
}

/// The whole obstacle, with its limbs at rest.
Mesh WholeMeshOf(const ScenarioObstacle& obstacle) {
  Mesh whole;
  for (int limb = -1; limb < static_cast<int>(obstacle.gait.limbs.size()); ++limb) {
    const Mesh mesh = MeshOf(obstacle, limb);
    whole.parts.insert(whole.parts.end(), mesh.parts.begin(), mesh.parts.end());
  }
  return whole;
}

TEST(ObstaclePresets, BoxesReachNoFurtherThanTheMeshAndStandOnTheGround) {
  for (const std::string& preset : Presets()) {
    SCOPED_TRACE(preset);
    const ScenarioObstacle obstacle = Obstacle(preset);
    const Mesh mesh = WholeMeshOf(obstacle);
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (const MeshPart& part : mesh.parts) {
      for (const Eigen::Vector3f& p : part.positions_m) {
        low = low.cwiseMin(p.cast<double>());
        high = high.cwiseMax(p.cast<double>());
      }
    }
    // A vehicle's body ends above its wheels; the foot of a tree or stake is in the ground.
    if (obstacle.wheels.empty()) {
      EXPECT_NEAR(low.z(), 0, 0.11);
    }
    if (!obstacle.wheels.empty()) low.z() = 0;
    for (const CollisionBox& box : obstacle.collision) {
      const Vec3 half = 0.5 * box.size_m;
      EXPECT_TRUE(((box.X_BG.translation() - half).array() > low.array() - 0.1).all());
      EXPECT_TRUE(((box.X_BG.translation() + half).array() < high.array() + 0.1).all());
    }
  }
}

TEST(ObstaclePresets, PersonsHaveCocosKeyPointsWithinTheirBodies) {
  int persons = 0;
  for (const std::string& preset : Presets()) {
    const ScenarioObstacle obstacle = Obstacle(preset);
    if (obstacle.label != SemanticClass::kPerson) continue;
    ++persons;
    SCOPED_TRACE(preset);
    ASSERT_EQ(obstacle.keypoints.size(), 17u);
    EXPECT_EQ(obstacle.keypoints.front().name, "nose");
    EXPECT_EQ(obstacle.keypoints.back().name, "right_ankle");
    for (const ObstacleKeypoint& point : obstacle.keypoints) {
      const Mesh mesh = MeshOf(obstacle, point.limb);
      EXPECT_LE(DistanceTo(mesh, point.p_B_m), point.radius_m) << point.name;
    }
  }
  EXPECT_GE(persons, 7);
}

/// Key points by name.
std::map<std::string, Vec3> PointsOf(const std::string& preset) {
  std::map<std::string, Vec3> points;
  for (const ObstacleKeypoint& point : Obstacle(preset).keypoints) points[point.name] = point.p_B_m;
  return points;
}

/// Key points of one side with constant distances.
constexpr std::pair<const char*, const char*> kBones[] = {
    {"shoulder", "elbow"}, {"elbow", "wrist"}, {"hip", "knee"}, {"knee", "ankle"}, {"eye", "ear"}};

TEST(ObstaclePresets, JointsOfEveryPoseAreAsFarApartAsThoseOfTheStandingOne) {
  auto standing = PointsOf("person_standing");
  for (const char* preset : {"person", "person_step", "person_pass", "person_crouching",
                             "person_pointing", "person_lying"}) {
    auto points = PointsOf(preset);
    for (const std::string side : {"left_", "right_"}) {
      for (const auto& [from, to] : kBones) {
        EXPECT_NEAR((points[side + from] - points[side + to]).norm(),
                    (standing[side + from] - standing[side + to]).norm(), 0.005)
            << preset << " " << side << from;
      }
    }
  }
}

TEST(ObstaclePresets, PosesAreWhatTheyAreCalled) {
  auto crouching = PointsOf("person_crouching"), pointing = PointsOf("person_pointing"),
       lying = PointsOf("person_lying"), walking = PointsOf("person"),
       other = PointsOf("person_step");
  EXPECT_LT(crouching["nose"].z(), 1.2);
  EXPECT_LT(crouching["left_hip"].z(), 0.6);
  // The left arm is level and straight ahead, the right one hangs.
  EXPECT_NEAR(pointing["left_wrist"].z(), pointing["left_shoulder"].z(), 0.08);
  EXPECT_GT(pointing["left_wrist"].x(), 0.5);
  EXPECT_LT(pointing["right_wrist"].z(), 1.0);
  for (const auto& [name, p] : lying) EXPECT_LT(p.z(), 0.45) << name;
  EXPECT_GT(lying["nose"].z(), lying["left_ear"].z());  // face up
  EXPECT_GT(walking["left_ankle"].x(), walking["right_ankle"].x());
  EXPECT_LT(other["left_ankle"].x(), other["right_ankle"].x());
}

TEST(ObstaclePresets, ATrucksWheelsRollOverTheGroundWithoutSlipping) {
  const Scenario scenario = With(
      "{name: truck1, preset: 'tera:config/obstacles/truck_driving.yaml', xy_m: [0, 9], path: "
      "[{t_s: 0, xy_m: [-3, 8]}, {t_s: 1, xy_m: [0, 8]}, {t_s: 2, xy_m: [0, 12]}]}");
  const SceneAssembly assembly(scenario);
  const Simulation simulation(scenario);
  const auto wheel_at = [&](double t_s) {
    Instant now = simulation.state();
    now.t_ns = static_cast<TimeNs>(t_s * 1e9);
    now.obstacles[0] = ObstacleAt(scenario.obstacles[0], now.t_ns, simulation.ground());
    const std::vector<Pose> poses = assembly.BodyPoses(now);
    return std::pair(now.obstacles[0].X_WB, poses[poses.size() - 6]);  // the front left one
  };
  for (const double t_s : {0.0, 0.4, 1.3, 5.0}) {
    const auto [X_WB, X_WW] = wheel_at(t_s);
    const double travel_m = t_s < 1 ? 3 * t_s : t_s < 2 ? 3 + 4 * (t_s - 1) : 7;
    EXPECT_LT((X_WB.inverse() * X_WW.translation() - Vec3(2.35, 1.05, 0.5)).norm(), 1e-9);
    // A point at the top has moved forwards by its rotation about the axle along y.
    const Mat3 R = (X_WB.inverse() * X_WW).linear();
    EXPECT_LT(
        (R * Vec3::UnitZ() - Vec3(std::sin(travel_m / 0.5), 0, std::cos(travel_m / 0.5))).norm(),
        1e-6)
        << t_s;
  }
}

TEST(ObstaclePresets, ATrucksBedTurnsAboutItsHingeAndTheGateHangsFromItsTail) {
  const Scenario scenario = With(
      "{name: truck1, preset: 'tera:config/obstacles/truck_driving.yaml', xy_m: [0, 9], yaw_deg: "
      "30, tips: [{t_s: 1, angle_deg: 0}, {t_s: 3, angle_deg: 60}]}");
  const SceneAssembly assembly(scenario);
  const Simulation simulation(scenario);
  for (const auto& [t_s, tip_deg] : {std::pair{0.0, 0.0}, {2.0, 30.0}, {2.5, 45.0}, {7.0, 60.0}}) {
    Instant now = simulation.state();
    now.t_ns = static_cast<TimeNs>(t_s * 1e9);
    const std::vector<Pose> poses = assembly.BodyPoses(now);
    const Pose X_BW = now.obstacles[0].X_WB.inverse();
    const Pose X_BT = X_BW * poses[poses.size() - 8], X_BG = X_BW * poses[poses.size() - 7];
    // The middle of its floor lies 2.435 m ahead of the hinge and 0.155 m above it.
    const double c = std::cos(tip_deg * kDeg), s = std::sin(tip_deg * kDeg);
    EXPECT_LT((X_BT * Vec3(-1.095, 0, 1.175) -
               Vec3(-3.53 + 2.435 * c - 0.155 * s, 0, 1.02 + 2.435 * s + 0.155 * c))
                  .norm(),
              1e-9)
        << t_s;
    const Vec3 edge_B(-3.625, 0, 2.195);  // of the tail, over the gate
    EXPECT_LT((X_BG * edge_B - X_BT * edge_B).norm(), 1e-9);
    EXPECT_LT((X_BG.linear() - Mat3::Identity()).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace tera
