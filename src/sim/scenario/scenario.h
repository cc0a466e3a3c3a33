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
#include "sim/scenario/sling.h"
#include "sim/scenario/terrain_record.h"
#include "sim/task/task.h"
#include "soil/site/site.h"

namespace tera {

/// A machine in a scenario: its model, start, operator and sensors.
struct ScenarioMachine {
  /// On the ground; height and tilt at rest are estimated from the terrain.
  MachinePlacement placement;
  OperatorPlan driver;
  std::vector<SensorDescription> sensors;
  Tolerances tolerances;  ///< the owner's tolerances, in addition to the built-in ones
  Wear wear;
};

struct PathPoint {
  double t_s = 0;
  Vec2 xy_W_m = Vec2::Zero();
};

/// Tipping of an obstacle's bed. Meshes are nodes of the obstacle's own file.
struct TippingBed {
  /// A point on the hinge; the bed turns about the y axis through it.
  Vec3 hinge_B_m = Vec3::Zero();
  /// A point on the upper edge of the tail gate, from which the gate hangs.
  Vec3 gate_B_m = Vec3::Zero();
  std::optional<Visual> visual, gate;  ///< meshes of the turning bed and of the gate
  struct Angle {
    double t_s, angle_rad;
  };
  std::vector<Angle> angles;  ///< linear in between
};

/// A named point of an obstacle, in the frame of its mesh.
struct ObstacleKeypoint {
  std::string name;
  Vec3 p_B_m = Vec3::Zero();
  double radius_m = 0;  ///< a visible surface may lie up to this distance in front of the point
  int limb = -1;        ///< index of the limb that carries it; -1: the body
};

/// A wheel of an obstacle. It turns as the obstacle moves along its path.
struct ObstacleWheel {
  Visual visual;                 ///< centre at the mesh's origin, axle along y
  Vec3 axle_B_m = Vec3::Zero();  ///< in the frame of the obstacle's mesh
  double radius_m = 1;
};

/// Mass of an obstacle that forces can push, lift, tip and stack.
struct ObstacleMass {
  double mass_kg = 0;
  Vec3 com_B_m = Vec3::Zero();  ///< in the frame of the obstacle's mesh
};

/// An object on the site that is not a machine: rock, barrier, cone, person, truck.
struct ScenarioObstacle {
  std::string name;
  SemanticClass label = SemanticClass::kRock;
  Visual visual;
  std::vector<CollisionBox> collision;
  std::optional<SoilBed> bed;  ///< container into which soil can be dumped
  TippingBed tipping;
  std::optional<ObstacleMass> dynamic;  ///< empty: no force moves the obstacle
  Vec2 xy_W_m = Vec2::Zero();
  double yaw_rad = 0;
  double height_above_ground_m = 0;
  std::vector<PathPoint> path;  ///< empty: the obstacle does not move along a path
  std::vector<ObstacleKeypoint> keypoints;
  std::vector<ObstacleWheel> wheels;
  Gait gait;
  Wear wear;  ///< ignored for people, rocks and plants
};

/// A site with its machines, objects and sensors: everything that a run needs and does not change.
/// Several runs may share a scenario. Copies share the site.
struct Scenario {
  std::string name;
  std::uint64_t seed = 0;
  double duration_s = 0;
  double physics_rate_hz = 500;
  double settle_s = 0;  ///< time before t = 0 in which machines settle, with neutral levers
  SiteOrigin origin;
  Environment environment;
  std::shared_ptr<const Site> site;  ///< includes ground that effects of the machines raise
  std::shared_ptr<const SiteMesh> site_mesh;  ///< null without the key `environment.mesh`
  std::vector<ScenarioMachine> machines;
  std::vector<ScenarioObstacle> obstacles;
  std::vector<Sling> slings;
  std::optional<Task> task;
  std::vector<ScenarioLamp> lamps;
  TerrainRecord record;
  std::optional<double>
      /// Rate at which poses of links, sensors and obstacles are recorded; empty: not recorded.
      poses_hz;
  std::vector<std::string> drawn;  ///< "key: value" for each value that `randomise:` drew
  /// Input files other than YAML. Files that a mesh refers to are not listed.
  std::vector<InputFile> inputs;
};

/// Reads a scenario and all files that it names. Faults go to `config`; call Config::Finish before
/// using the result.
Scenario ReadScenario(const ConfigMap& config);

/// The seed of all the scenario's random streams.
std::uint64_t SeedOf(const ConfigMap& config);

/// An obstacle's boxes for collisions with machines.
RigidObstacle RigidPartOf(const ScenarioObstacle& obstacle);

/// Pose and velocity of an obstacle at `t_ns`, on its path or at its start, on the given ground. It
/// stands upright; a dynamic obstacle stands perpendicular to the mean slope.
BodyState ObstacleAt(const ScenarioObstacle& obstacle, TimeNs t_ns, const TerrainSurface& ground);

/// Angle of the tipped bed at `t_ns`.
double TipOf(const ScenarioObstacle& obstacle, TimeNs t_ns);

/// Frame of the tipped bed, relative to the obstacle's mesh. It is the identity while the bed is
/// down.
Pose TippedBed(const ScenarioObstacle& obstacle, TimeNs t_ns);

/// Distance travelled along the path at `t_ns`.
double TravelOf(const ScenarioObstacle& obstacle, TimeNs t_ns);

}  // namespace tera
