#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"
#include "core/time.h"
#include "core/types/tolerance.h"
#include "physics/description/machine_placement.h"
#include "render/scene.h"
#include "sensors/sensor.h"
#include "sim/operators/operator_plan.h"
#include "sim/scenario/gait.h"
#include "sim/scenario/scenario_lamp.h"
#include "sim/scenario/site_mesh.h"
#include "sim/scenario/terrain_record.h"
#include "soil/site/site.h"

namespace tera {

/// A machine in a scenario: what it is, where it starts, who drives it, what it carries.
struct ScenarioMachine {
  MachinePlacement placement;  ///< on the ground, resting pose estimated from the terrain
  OperatorPlan driver;
  std::vector<SensorDescription> sensors;
  Tolerances tolerances;  ///< what its owner takes as expected, beside what is always
  Wear wear;              ///< of all its parts
};

/// A point of a moving obstacle's path.
struct PathPoint {
  double t_s = 0;
  Vec2 xy_W_m = Vec2::Zero();
};

/// A named point of an obstacle, in the frame of its mesh.
struct ObstacleKeypoint {
  std::string name;
  Vec3 p_B_m = Vec3::Zero();
  double radius_m = 0;  ///< how deep below its surface it may lie and still be seen
  int limb = -1;        ///< of its gait, which it moves with; -1: the body
};

/// A wheel of an obstacle: it turns as the obstacle moves along its path, forwards.
struct ObstacleWheel {
  Visual visual;                 ///< its middle at its origin, its axle along y
  Vec3 axle_B_m = Vec3::Zero();  ///< in the frame of the obstacle's mesh
  double radius_m = 1;
};

/// Something on the site that is not a machine: rock, barrier, cone, person, truck.
struct ScenarioObstacle {
  std::string name;
  SemanticClass label = SemanticClass::kRock;
  Visual visual;
  std::vector<CollisionBox> collision;
  std::optional<SoilBed> bed;  ///< soil may be dumped into it
  Vec2 xy_W_m = Vec2::Zero();
  double yaw_rad = 0;
  double height_above_ground_m = 0;
  std::vector<PathPoint> path;  ///< empty: stands still
  std::vector<ObstacleKeypoint> keypoints;
  std::vector<ObstacleWheel> wheels;
  Gait gait;
  Wear wear;  ///< none of people, rocks and plants
};

/// A site, what stands and moves on it, and how it is measured: everything a run needs, and nothing
/// that a run changes. Runs share it; copies share the site.
struct Scenario {
  std::string name;
  std::uint64_t seed = 0;
  double duration_s = 0;
  double physics_rate_hz = 500;
  double settle_s = 0;  ///< simulated before t = 0, levers neutral, so that machines rest
  SiteOrigin origin;
  Environment environment;
  std::shared_ptr<const Site> site;           ///< raised by the effects of the machines
  std::shared_ptr<const SiteMesh> site_mesh;  ///< or null
  std::vector<ScenarioMachine> machines;
  std::vector<ScenarioObstacle> obstacles;
  std::vector<ScenarioLamp> lamps;
  TerrainRecord record;
  std::optional<double> poses_hz;  ///< at which poses of links, sensors and obstacles are kept
  std::vector<std::string> drawn;  ///< "key: value" of what `randomise:` drew
  /// What it was read from besides YAML, but for files that meshes name.
  std::vector<InputFile> inputs;
};

/// Reads a scenario and everything it names. Faults go to `config`; call Config::Finish before use.
Scenario ReadScenario(const ConfigMap& config);

/// The seed of all its streams.
std::uint64_t SeedOf(const ConfigMap& config);

/// An obstacle's boxes as machines drive over them or against them.
RigidObstacle RigidPartOf(const ScenarioObstacle& obstacle);

/// Pose and velocity of an obstacle at `t_ns` on the given ground, upright.
BodyState ObstacleAt(const ScenarioObstacle& obstacle, TimeNs t_ns, const TerrainSurface& ground);

/// How far it has come along its path at `t_ns`.
double TravelOf(const ScenarioObstacle& obstacle, TimeNs t_ns);

}  // namespace tera
