#include "app/viewed_stage.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "dataset/format/recording.h"
#include "sim/obstacle_bodies.h"
#include "sim/run/recorded_run.h"
#include "sim/scene_assembly.h"

namespace tera {
namespace {

constexpr double kObstacle_hz = 10;  ///< sampling rate of the poses of moving objects

std::vector<float> Flat(const std::vector<Eigen::Vector3f>& points) {
  std::vector<float> numbers;
  numbers.reserve(3 * points.size());
  for (const Eigen::Vector3f& p : points) numbers.insert(numbers.end(), p.data(), p.data() + 3);
  return numbers;
}

StageMesh StageMeshOf(const Mesh& mesh) {
  StageMesh staged;
  for (const MeshPart& part : mesh.parts) {
    staged.parts.push_back({.positions_m = Flat(part.positions_m),
                            .normals = Flat(part.normals),
                            .colours = Flat(part.albedos),
                            .indices = part.indices,
                            .colour = part.material.albedo,
                            .opacity = part.material.opacity});
  }
  return staged;
}

std::string MotionOf(JointType type) {
  if (type == JointType::kFixed) return "fixed";
  return type == JointType::kPrismatic ? "slides" : "turns";
}

void AddJoints(const MachineModel& model, StageMachine* machine) {
  for (const Link& link : model.links) machine->links.push_back(link.name);
  for (const Joint& joint : model.joints) {
    machine->joints.push_back({joint.name, MotionOf(joint.type), joint.parent, joint.child,
                               joint.X_PJ, joint.axis_J, joint.initial_rad});
  }
}

void AddRunningGear(const MachineModel& model, StageMachine* machine) {
  for (const RunningGear& gear : model.ground_tools.gears) {
    machine->gears.push_back({gear.name, gear.link, gear.ShoeRadius_m()});
  }
  for (const WheelVisual& wheel : model.wheel_visuals) {
    machine->wheels.push_back({wheel.gear, wheel.axle_B_m});
  }
  for (const TrackVisual& track : model.track_visuals) {
    machine->tracks.push_back({track.gear, track.shoe_count, track.path_B_m});
  }
}

void AddLinkages(const MachineModel& model, StageMachine* machine) {
  for (const FourBar& one : model.linkages) {
    machine->linkages.push_back({one.joint, one.rocker_pin_P_m, one.coupler_pin_B_m, one.rocker_m,
                                 one.coupler_m, one.branch});
  }
  for (const Cylinder& one : model.cylinders) {
    machine->cylinders.push_back({one.joint, one.barrel_link, one.rod_link, one.linkage, one.count,
                                  one.barrel_pin_m, one.rod_pin_m, one.spacing_m});
  }
  for (const Shovel& shovel : model.ground_tools.shovels) {
    if (shovel.capacity_m3 > 0) machine->loads.push_back(shovel.link);
  }
}

int BodiesOf(const StageMachine& machine) {
  std::size_t bodies = machine.links.size() + machine.wheels.size() + 2 * machine.linkages.size() +
                       machine.loads.size();
  for (const StageMachine::Track& track : machine.tracks) bodies += track.shoes;
  for (const StageMachine::Cylinder& one : machine.cylinders) bodies += 2 * one.count;
  return static_cast<int>(bodies);
}

StageMachine StageMachineOf(const MachinePlacement& placement, int first_body) {
  StageMachine machine{.name = placement.name, .first_body = first_body};
  AddJoints(placement.model, &machine);
  AddRunningGear(placement.model, &machine);
  AddLinkages(placement.model, &machine);
  return machine;
}

/// Poses of a moving obstacle, sampled at kObstacle_hz. Only its initial pose if none are recorded.
std::vector<std::pair<double, Pose>> TrackOf(const Recording& recording,
                                             const ScenarioObstacle& obstacle,
                                             const TerrainSurface& ground) {
  const std::string file = "truth/" + obstacle.name + "/pose.csv";
  if (!recording.Has(file)) return {{0, ObstacleAt(obstacle, 0, ground).X_WB}};
  std::vector<std::pair<double, Pose>> track;
  for (const TruthPose& pose : recording.LoadPose(file).poses) {
    const double t_s = ToSeconds(pose.t_ns);
    if (track.empty() || t_s - track.back().first >= 1 / kObstacle_hz) {
      track.emplace_back(t_s, pose.X_WB);
    }
  }
  return track;
}

/// Adds the bodies of an obstacle: body, bed and gate, wheels, limbs.
void AddObstacle(const Scenario& scenario, const ScenarioObstacle& obstacle,
                 const Recording& recording, Stage* stage) {
  if (obstacle.dynamic) {
    stage->obstacles.push_back(
        {obstacle.name, stage->bodies++, TrackOf(recording, obstacle, scenario.site->surface())});
    return;
  }
  const std::size_t bodies = 1 + (obstacle.tipping.visual ? 1 : 0) +
                             (obstacle.tipping.gate ? 1 : 0) + obstacle.wheels.size() +
                             obstacle.gait.limbs.size();
  std::vector<StageObstacle> staged;
  for (std::size_t k = 0; k < bodies; ++k) {
    staged.push_back({.name = obstacle.name, .body = stage->bodies++, .X_WB_at_s = {}});
  }
  double end_s = obstacle.path.empty() ? 0 : obstacle.path.back().t_s;
  if (!obstacle.tipping.angles.empty()) {
    end_s = std::max(end_s, obstacle.tipping.angles.back().t_s);
  }
  const int steps = static_cast<int>(std::ceil(end_s * kObstacle_hz));
  for (int step = 0; step <= steps; ++step) {
    const double t_s = step / kObstacle_hz;
    const TimeNs t_ns = FromSeconds(t_s);
    std::vector<Pose> poses;
    AppendObstaclePoses(obstacle, ObstacleAt(obstacle, t_ns, scenario.site->surface()).X_WB, t_ns,
                        &poses);
    for (std::size_t k = 0; k < bodies; ++k) staged[k].X_WB_at_s.emplace_back(t_s, poses[k]);
  }
  stage->obstacles.insert(stage->obstacles.end(), staged.begin(), staged.end());
}

Stage StageOf(const Scenario& scenario, const Recording& recording) {
  const SceneAssembly assembly(scenario);
  const SceneModel& model = assembly.model();
  Stage stage;
  for (const ScenarioMachine& machine : scenario.machines) {
    stage.machines.push_back(StageMachineOf(machine.placement, stage.bodies));
    stage.bodies += BodiesOf(stage.machines.back());
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    AddObstacle(scenario, obstacle, recording, &stage);
  }
  for (const Mesh& mesh : model.meshes) stage.meshes.push_back(StageMeshOf(mesh));
  for (const SceneNode& node : model.nodes) {
    if (node.shape >= 0) continue;
    stage.nodes.push_back({node.mesh, node.body, node.X_BG, node.scale, node.instance});
  }
  return stage;
}

}  // namespace

Stage StageOfRecording(const std::filesystem::path& recording,
                       const std::vector<std::string>& moved) {
  const Recording recorded(recording);
  if (!recorded.info().simulated) {
    throw InputError(
        recording.string(),
        {FaultKind::kUnsupported, "is a real recording, and no scenario describes its machine"});
  }
  return StageOf(LoadRecordedScenario(recording, {}, moved).scenario, recorded);
}

}  // namespace tera
