#include "sim/physics_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/units.h"
#include "sim/dynamic_obstacle.h"

namespace tera {
namespace {

/// Depth that no ground contact of a valid machine reaches: a machine sinks and tilts by less than
/// its own height.
constexpr double kBelowGround_m = 3;

/// The highest of the links' centres of mass.
Vec3 HighestCentre_m(const MachineModel& model, const MachineState& machine) {
  Vec3 highest_m = machine.links[0].X_WB * model.links[0].com_B_m;
  for (std::size_t i = 1; i < model.links.size(); ++i) {
    const Vec3 centre_m = machine.links[i].X_WB * model.links[i].com_B_m;
    if (centre_m.z() > highest_m.z()) highest_m = centre_m;
  }
  return highest_m;
}

/// Throws InputError if a machine has fallen through the ground.
void RequireAboveGround(const MachinePlacement& placement, const MachineState& machine,
                        const TerrainSurface& ground, TimeNs t_ns) {
  if (placement.model.fixed_base) return;
  const Vec3 top_m = HighestCentre_m(placement.model, machine);
  const double bottom_m = top_m.z() + kBelowGround_m;
  if (bottom_m > ground.HeightAt(top_m.x(), top_m.y()) || bottom_m > ground.Lowest_m()) return;
  throw InputError(
      "machine " + placement.name,
      {FaultKind::kInconsistent,
       fmt::format("has fallen below all ground at {:.2f} s, to ({:.1f}, {:.1f}, "
                   "{:.1f}) m: {}",
                   ToSeconds(t_ns), top_m.x(), top_m.y(), top_m.z(),
                   placement.model.BearsOnGround()
                       ? "its tracks, wheels and hull_points did not support it; correct their "
                         "positions, or its mass"
                       : "it touches nothing; give it tracks, wheels or hull_points, or "
                         "fixed_base: true")});
}

}  // namespace

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
    const BodyState& state = world->obstacles[o];
    if (obstacle.dynamic) {
      placements.push_back(PlacementOf(obstacle, state.X_WB));
      const GroundTools& tools = placements.back().model.ground_tools;
      things_.push_back({o, world->ground().AddMachine(tools)});
    } else {
      guided_.push_back(o);
      obstacles.push_back({obstacle.name, obstacle.collision, state, RigidPartOf(obstacle).rise_m});
    }
  }
  physics_ = std::make_unique<PhysicsWorld>(
      placements, obstacles, kStandardGravity_mps2, WorldStart{scenario_.seed, begin.first_step},
      scenario_.site_mesh ? scenario_.site_mesh->Walls() : SiteWalls{});
  ReadBodies(world);
}

void PhysicsMotion::ReadBodies(WorldState* world) const {
  const std::vector<MachineState>& bodies = physics_->machines();
  const auto first_thing = bodies.begin() + static_cast<std::ptrdiff_t>(scenario_.machines.size());
  world->machines.assign(bodies.begin(), first_thing);
  for (std::size_t k = 0; k < things_.size(); ++k) {
    world->obstacles[things_[k].obstacle] = first_thing[static_cast<std::ptrdiff_t>(k)].links[0];
  }
  ReadContacts(world);
}

BodyContact::Side PhysicsMotion::OfScenario(BodyContact::Side side) const {
  const std::size_t machines = scenario_.machines.size();
  if (side.kind == BodyContact::Kind::kObstacle) {
    side.index = guided_[side.index];
  } else if (side.kind == BodyContact::Kind::kMachine && side.index >= machines) {
    return {BodyContact::Kind::kObstacle, things_[side.index - machines].obstacle, 0};
  }
  return side;
}

void PhysicsMotion::ReadContacts(WorldState* world) const {
  world->contacts.clear();
  for (const BodyContact& contact : physics_->contacts()) {
    const BodyContact::Side a = OfScenario(contact.a), b = OfScenario(contact.b);
    const Vec3& force_W_n = contact.force_W_n;
    if (a.kind == BodyContact::Kind::kMachine) {
      world->contacts.push_back({a, b, contact.p_W_m, force_W_n});
    }
    if (b.kind == BodyContact::Kind::kMachine) {
      world->contacts.push_back({b, a, contact.p_W_m, -force_W_n});
    }
  }
}

void PhysicsMotion::Move(const Step& step, WorldState* world) {
  std::vector<MachineInput> inputs;
  for (std::size_t m = 0; m < scenario_.machines.size(); ++m) {
    inputs.push_back({.levers = LeversOf(m, *world), .soil = step.reactions[m]});
  }
  for (const Thing& thing : things_) {
    const std::vector<BodyState> links{world->obstacles[thing.obstacle]};
    inputs.push_back(
        {.levers = {}, .soil = world->ground().Act(thing.soil_handle, {&links, {}}, step.dt_s)});
  }
  PullSlings(*world, &inputs);
  std::vector<BodyState> guided;
  for (const std::size_t o : guided_) guided.push_back(world->obstacles[o]);
  physics_->Step(inputs, guided, step.dt_s);
  ReadBodies(world);
  for (std::size_t m = 0; m < scenario_.machines.size(); ++m) {
    RequireAboveGround(scenario_.machines[m].placement, world->machines[m],
                       world->ground().surface(), step.to_ns);
  }
}

void PhysicsMotion::PullSlings(const WorldState& world, std::vector<MachineInput>* inputs) const {
  const double t_s = ToSeconds(world.t_ns);
  for (const Sling& sling : scenario_.slings) {
    if (t_s < sling.from_s || t_s >= sling.until_s) continue;
    const auto thing = std::ranges::find(things_, sling.obstacle, &Thing::obstacle);
    const std::size_t input =
        scenario_.machines.size() + static_cast<std::size_t>(thing - things_.begin());
    const std::size_t link = static_cast<std::size_t>(sling.link);
    Pull(sling, scenario_.obstacles[sling.obstacle].dynamic->mass_kg,
         world.machines[sling.machine].links[link], world.obstacles[sling.obstacle],
         &(*inputs)[sling.machine].soil.link_wrench[link], &(*inputs)[input].soil.link_wrench[0]);
  }
}

std::vector<double> PhysicsMotion::LeversOf(std::size_t machine, const WorldState& world) {
  const MachineModel& model = scenario_.machines[machine].placement.model;
  if (world.t_ns < start_ns_) return std::vector<double>(model.levers.size(), 0.0);
  return operators_[machine]->Levers(
      {world.t_ns, model, world.machines[machine], world.ground().surface()});
}

}  // namespace tera
