#include "sim/physics_motion.h"

#include <utility>

#include "core/check.h"
#include "core/units.h"

namespace tera {

Operators OperatorsOf(const Scenario& scenario) {
  Operators operators;
  for (const ScenarioMachine& machine : scenario.machines) {
    const MachinePlacement& placement = machine.placement;
    operators.push_back(
        MakeOperator(machine.driver, placement.model, {scenario.seed, placement.name}));
  }
  return operators;
}

PhysicsMotion::PhysicsMotion(const Scenario& scenario, Operators operators)
    : scenario_(scenario), operators_(std::move(operators)) {
  TERA_CHECK(operators_.size() == scenario.machines.size(), operators_.size());
}

void PhysicsMotion::Start(const Begin& begin, WorldState* world) {
  start_ns_ = begin.start_ns;
  std::vector<MachinePlacement> placements;
  for (const ScenarioMachine& machine : scenario_.machines) placements.push_back(machine.placement);
  std::vector<ObstacleBody> obstacles;
  for (std::size_t o = 0; o < scenario_.obstacles.size(); ++o) {
    const ScenarioObstacle& obstacle = scenario_.obstacles[o];
    obstacles.push_back(
        {obstacle.name, obstacle.collision, world->obstacles[o], RigidPartOf(obstacle).rise_m});
  }
  physics_ = std::make_unique<PhysicsWorld>(
      placements, obstacles, kStandardGravity_mps2, WorldStart{scenario_.seed, begin.first_step},
      scenario_.site_mesh ? scenario_.site_mesh->Walls() : SiteWalls{});
  world->machines = physics_->machines();
}

void PhysicsMotion::Move(const Step& step, WorldState* world) {
  std::vector<MachineInput> inputs(scenario_.machines.size());
  for (std::size_t m = 0; m < inputs.size(); ++m) {
    inputs[m] = {.levers = LeversOf(m, *world), .soil = step.reactions[m]};
  }
  physics_->Step(inputs, world->obstacles, step.dt_s);
  world->machines = physics_->machines();
}

std::vector<double> PhysicsMotion::LeversOf(std::size_t machine, const WorldState& world) {
  const MachineModel& model = scenario_.machines[machine].placement.model;
  if (world.t_ns < start_ns_) return std::vector<double>(model.levers.size(), 0.0);
  return operators_[machine]->Levers(
      {world.t_ns, model, world.machines[machine], world.ground().surface()});
}

}  // namespace tera
