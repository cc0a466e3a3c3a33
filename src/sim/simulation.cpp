#include "sim/simulation.h"

#include <cmath>
#include <utility>

#include "core/stopwatch.h"

namespace tera {

Simulation::Simulation(const Scenario& scenario) : Simulation(scenario, OperatorsOf(scenario)) {}

Simulation::Simulation(const Scenario& scenario, Operators operators)
    : Simulation(scenario, std::make_unique<PhysicsMotion>(scenario, std::move(operators))) {}

Simulation::Simulation(const Scenario& scenario, std::unique_ptr<MotionSource> motion,
                       TimeNs start_ns)
    : scenario_(scenario),
      clock_{.rate_hz = scenario.physics_rate_hz, .start_ns = start_ns},
      step_(-std::llround(scenario.settle_s * scenario.physics_rate_hz)),
      motion_(std::move(motion)),
      state_(MakeSoil(*scenario.site, scenario.seed)) {
  Soil& ground = state_.ground();
  for (const ScenarioMachine& machine : scenario.machines) {
    soil_handle_.push_back(ground.AddMachine(machine.placement.model.ground_tools));
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    obstacle_handle_.push_back(ground.AddObstacle(RigidPartOf(obstacle)));
    bed_handle_.emplace_back();
    if (obstacle.bed) bed_handle_.back() = ground.AddBed(*obstacle.bed);
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    state_.obstacles.push_back(ObstacleAt(obstacle, start_ns, ground.surface()));
  }
  ShowObstaclesToSoil(start_ns);
  motion_->Start({start_ns, step_}, &state_);
  Count();
  while (step_ < 0) Step();
  ground.MarkStart();
}

void Simulation::Step() {
  const double dt_s = 1.0 / scenario_.physics_rate_hz;
  const std::vector<SoilReaction> reactions = GroundActs();
  previous_ = state_;
  ++step_;
  const TimeNs to_ns = clock_.Due(step_);
  MoveAlongPaths(to_ns);
  {
    const Stopwatch watch(&physics_wall_s_);
    motion_->Move({to_ns, dt_s, reactions}, &state_);
  }
  {
    const Stopwatch watch(&soil_wall_s_);
    ShowObstaclesToSoil(to_ns);
    state_.ground().LetWeatherAct(to_ns - clock_.start_ns);
    state_.ground().Flow(dt_s);
  }
  Count();
}

std::vector<SoilReaction> Simulation::GroundActs() {
  const Stopwatch watch(&soil_wall_s_);
  std::vector<SoilReaction> reactions(state_.machines.size());
  for (std::size_t m = 0; m < reactions.size(); ++m) {
    if (!motion_->IsKnown(m)) continue;
    const MachineState& machine = state_.machines[m];
    reactions[m] = state_.ground().Act(soil_handle_[m], {&machine.links, machine.gear_rate_radps},
                                       1.0 / scenario_.physics_rate_hz);
  }
  return reactions;
}

void Simulation::MoveAlongPaths(TimeNs t_ns) {
  for (std::size_t o = 0; o < state_.obstacles.size(); ++o) {
    const ScenarioObstacle& obstacle = scenario_.obstacles[o];
    if (!obstacle.dynamic) state_.obstacles[o] = ObstacleAt(obstacle, t_ns, ground());
  }
}

void Simulation::ShowObstaclesToSoil(TimeNs t_ns) {
  for (std::size_t o = 0; o < state_.obstacles.size(); ++o) {
    state_.ground().MoveObstacle(obstacle_handle_[o], state_.obstacles[o]);
    if (!bed_handle_[o]) continue;
    const ScenarioObstacle& obstacle = scenario_.obstacles[o];
    const Pose X_WT = state_.obstacles[o].X_WB * TippedBed(obstacle, t_ns);
    state_.ground().MoveBed(*bed_handle_[o], X_WT, TipOf(obstacle, t_ns) > 0);
  }
}

/// Advances time and updates the loads of beds.
void Simulation::Count() {
  state_.t_ns = clock_.Due(step_);
  state_.beds.clear();
  for (const std::optional<int>& bed : bed_handle_) {
    state_.beds.push_back(bed ? state_.ground().bed_load(*bed) : BedLoad{});
  }
}

}  // namespace tera
