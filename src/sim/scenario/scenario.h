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
  MachinePlacement placement;  ///< on the ground; the resting pose is estimated from the terrain
  OperatorPlan driver;
  std::vector<SensorDescription> sensors;
  Tolerances tolerances;  ///< the owner's tolerances, in addition to the fixed ones
  Wear wear;              ///< wear of all its parts
};

/// A point of a moving obstacle's path.
struct PathPoint {
  double t_s = 0;
  Vec2 xy_W_m = Vec2::Zero();
};

/// How the bed of an obstacle tips, with nodes of the obstacle's own mesh.
struct TippingBed {
  Vec3 hinge_B_m = Vec3::Zero();       ///< on the line across about which the floor turns
  Vec3 gate_B_m = Vec3::Zero();        ///< the upper edge of its gate, from which that hangs
  std::optional<Visual> visual, gate;  ///< what turns, and what hangs
  struct Angle {
    double t_s, angle_rad;
  };
  std::vector<Angle> angles;  ///< in between they are linear
};

/// A named point of an obstacle, in the frame of its mesh.
struct ObstacleKeypoint {
  std::string name;
  Vec3 p_B_m = Vec3::Zero();
  double radius_m = 0;  ///< largest depth below its surface at which it counts as visible
  int limb = -1;        ///< limb of its gait that carries it; -1: the body
};

/// A wheel of an obstacle. It turns with the obstacle's forward motion along its path.
struct ObstacleWheel {
  Visual visual;                 ///< its middle at its origin, its axle along y
  Vec3 axle_B_m = Vec3::Zero();  ///< in the frame of the obstacle's mesh
  double radius_m = 1;
};

/// Mass of an obstacle that moves by forces: it can be pushed, lifted, tipped and stacked.
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
  std::optional<SoilBed> bed;           ///< soil can be dumped into it
  TippingBed tipping;                   ///< of the bed
  std::optional<ObstacleMass> dynamic;  ///< without it, no force moves the obstacle
  Vec2 xy_W_m = Vec2::Zero();
  double yaw_rad = 0;
  double height_above_ground_m = 0;
  std::vector<PathPoint> path;  ///< empty: it stands still
  std::vector<ObstacleKeypoint> keypoints;
  std::vector<ObstacleWheel> wheels;
  Gait gait;
  Wear wear;  ///< none for people, rocks and plants
};

/// A site, its machines and objects, and their sensors: everything that a run needs, and nothing
/// that a run changes. Runs share it; copies share the site.
struct Scenario {
  std::string name;
  std::uint64_t seed = 0;
  double duration_s = 0;
  double physics_rate_hz = 500;
  double settle_s = 0;  ///< settling time until t = 0, with neutral levers
  SiteOrigin origin;
  Environment environment;
  std::shared_ptr<const Site> site;           ///< with the ground raised by the machines' effects
  std::shared_ptr<const SiteMesh> site_mesh;  ///< may be null
  std::vector<ScenarioMachine> machines;
  std::vector<ScenarioObstacle> obstacles;
  std::vector<Sling> slings;
  std::optional<Task> task;
  std::vector<ScenarioLamp> lamps;
  TerrainRecord record;
  std::optional<double>
      poses_hz;  ///< rate at which poses of links, sensors and obstacles are recorded
  std::vector<std::string> drawn;  ///< "key: value" of each value that `randomise:` drew
  /// Its input files other than YAML, without the files that meshes name.
  std::vector<InputFile> inputs;
};

/// Reads a scenario and everything it names. Faults go to `config`; call Config::Finish before use.
Scenario ReadScenario(const ConfigMap& config);

/// The seed of all its streams.
std::uint64_t SeedOf(const ConfigMap& config);

/// An obstacle's boxes for collisions with machines.
RigidObstacle RigidPartOf(const ScenarioObstacle& obstacle);

/// Pose and velocity of an obstacle at `t_ns` on the given ground, on its path or where it starts:
/// upright, or normal to the ground's mean slope if it is dynamic.
BodyState ObstacleAt(const ScenarioObstacle& obstacle, TimeNs t_ns, const TerrainSurface& ground);

/// Angle by which its bed is tipped at `t_ns`.
double TipOf(const ScenarioObstacle& obstacle, TimeNs t_ns);

/// A frame of its bed that is the mesh's as long as the bed lies.
Pose TippedBed(const ScenarioObstacle& obstacle, TimeNs t_ns);

/// Distance along its path at `t_ns`.
double TravelOf(const ScenarioObstacle& obstacle, TimeNs t_ns);

}  // namespace tera
