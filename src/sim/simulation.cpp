#include "sim/simulation.h"

#include <algorithm>
#include <limits>

#include "core/stopwatch.h"
#include "core/units.h"

namespace tera {
namespace {

/// An obstacle's boxes as machines drive over them or against them.
RigidObstacle RigidPartOf(const ScenarioObstacle& obstacle) {
  RigidObstacle rigid;
  double highest_m = -std::numeric_limits<double>::infinity();
  for (const CollisionBox& box : obstacle.collision) {
    rigid.boxes.push_back({box.X_BG, box.size_m});
    const Vec3 up_G = box.X_BG.linear().row(2);
    highest_m =
        std::max(highest_m, box.X_BG.translation().z() + 0.5 * up_G.cwiseAbs().dot(box.size_m));
  }
  rigid.rise_m = obstacle.height_above_ground_m + highest_m;
  return rigid;
}

}  // namespace

Simulation::Simulation(Scenario* scenario)
    : scenario_(scenario),
      clock_{.rate_hz = scenario->physics_rate_hz},
      step_(-std::llround(scenario->settle_s * scenario->physics_rate_hz)) {
  std::vector<MachinePlacement> placements;
  for (const ScenarioMachine& machine : scenario->machines) {
    placements.push_back(machine.placement);
    soil_handle_.push_back(scenario->soil->AddMachine(machine.placement.model.ground_tools));
  }
  std::vector<ObstacleBody> obstacles;
  for (const ScenarioObstacle& obstacle : scenario->obstacles) {
    state_.obstacles.push_back(ObstacleAt(obstacle, 0, ground()));
    const RigidObstacle rigid = RigidPartOf(obstacle);
    obstacles.push_back({obstacle.name, obstacle.collision, state_.obstacles.back(), rigid.rise_m});
    obstacle_handle_.push_back(scenario->soil->AddObstacle(rigid));
    bed_handle_.emplace_back();
    if (obstacle.bed) bed_handle_.back() = scenario->soil->AddBed(*obstacle.bed);
  }
  MoveObstacles();
  physics_ = std::make_unique<PhysicsWorld>(placements, obstacles, kStandardGravity_mps2,
                                            WorldStart{scenario->seed, step_});
  Capture();
  while (step_ < 0) Step();
}

void Simulation::Step() {
  const double dt_s = 1.0 / scenario_->physics_rate_hz;
  std::vector<MachineInput> inputs(scenario_->machines.size());
  {
    const Stopwatch watch(&soil_wall_s_);
    for (std::size_t m = 0; m < inputs.size(); ++m) inputs[m].soil = GroundActsOn(m);
  }
  for (std::size_t m = 0; m < inputs.size(); ++m) inputs[m].levers = LeversOf(m);
  previous_ = state_;
  ++step_;
  for (std::size_t o = 0; o < state_.obstacles.size(); ++o) {
    state_.obstacles[o] = ObstacleAt(scenario_->obstacles[o], clock_.Due(step_), ground());
  }
  MoveObstacles();
  {
    const Stopwatch watch(&physics_wall_s_);
    physics_->Step(inputs, state_.obstacles, dt_s);
  }
  {
    const Stopwatch watch(&soil_wall_s_);
    scenario_->soil->Flow(dt_s);
  }
  Capture();
}

std::vector<double> Simulation::LeversOf(std::size_t machine) const {
  const ScenarioMachine& m = scenario_->machines[machine];
  if (step_ < 0) return std::vector<double>(m.placement.model.levers.size(), 0.0);
  return m.driver->Levers({state_.t_ns, m.placement.model, state_.machines[machine], ground()});
}

SoilReaction Simulation::GroundActsOn(std::size_t machine) {
  const MachineState& state = state_.machines[machine];
  GroundToolsMotion motion;
  motion.links = &state.links;
  motion.gear_rate_radps = state.gear_rate_radps;
  return scenario_->soil->Act(soil_handle_[machine], motion, 1.0 / scenario_->physics_rate_hz);
}

void Simulation::MoveObstacles() {
  for (std::size_t o = 0; o < bed_handle_.size(); ++o) {
    scenario_->soil->MoveObstacle(obstacle_handle_[o], state_.obstacles[o]);
    if (bed_handle_[o]) scenario_->soil->MoveBed(*bed_handle_[o], state_.obstacles[o].X_WB);
  }
}

void Simulation::Capture() {
  state_.t_ns = clock_.Due(step_);
  state_.machines = physics_->machines();
  state_.beds.clear();
  for (const std::optional<int>& bed : bed_handle_) {
    state_.beds.push_back(bed ? scenario_->soil->bed_load(*bed) : BedLoad{});
  }
}

}  // namespace tera
