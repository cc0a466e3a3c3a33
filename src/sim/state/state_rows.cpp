#include "sim/state/state_rows.h"

#include "core/check.h"
#include "physics/dynamics/link_motion.h"

namespace tera {
namespace {

/// Visits all numbers of a vector, matrix or list.
template <typename Numbers, typename Visit>
void ForAll(Numbers&& numbers, Visit visit) {
  for (auto& number : numbers) visit(number);
}

template <typename PoseType, typename Visit>
void ForPose(PoseType& pose, Visit visit) {
  for (int row = 0; row < 3; ++row) visit(pose.translation()(row));
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) visit(pose.linear()(row, column));
  }
}

template <typename BodyType, typename Visit>
void ForVelocities(BodyType& body, Visit visit) {
  ForAll(body.v_WB_mps, visit);
  ForAll(body.w_WB_radps, visit);
}

/// Visits all numbers of a row in order.
template <typename InstantType, typename Visit>
void ForRow(InstantType& state, Visit visit) {
  for (auto& machine : state.machines) {
    ForPose(machine.links.front().X_WB, visit);
    ForVelocities(machine.links.front(), visit);
    for (auto* list :
         {&machine.q_rad, &machine.qd_radps, &machine.gear_angle_rad, &machine.gear_rate_radps}) {
      ForAll(*list, visit);
    }
    for (auto& load : machine.shovel_load) {
      visit(load.mass_kg);
      visit(load.volume_m3);
      ForAll(load.com_B_m, visit);
      ForAll(load.surface_up_B, visit);
      ForAll(load.soil_kg, visit);
    }
  }
  for (auto& obstacle : state.obstacles) ForPose(obstacle.X_WB, visit);
  for (auto& bed : state.beds) {
    visit(bed.mass_kg);
    visit(bed.volume_m3);
  }
}

template <typename InstantType, typename Visit>
void ForLinkMotions(InstantType& state, Visit visit) {
  for (auto& machine : state.machines) {
    for (auto& link : machine.links) {
      ForPose(link.X_WB, visit);
      ForVelocities(link, visit);
      ForAll(link.a_WB_mps2, visit);
      ForAll(link.alpha_WB_radps2, visit);
    }
  }
}

/// Allocates the loads: one per shovel, with one mass per soil of the site.
void SizeLoads(const Scenario& scenario, std::size_t m, MachineState* machine) {
  machine->shovel_load.resize(scenario.machines[m].placement.model.ground_tools.shovels.size());
  for (SoilReaction::Load& load : machine->shovel_load) {
    load.soil_kg.resize(scenario.site->soils().size());
  }
}

/// An empty state with the sizes of the scenario.
Instant EmptyState(const Scenario& scenario) {
  Instant state;
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) {
    const MachineModel& model = scenario.machines[m].placement.model;
    MachineState& machine = state.machines.emplace_back();
    machine.links.resize(model.links.size());
    machine.q_rad.resize(model.joints.size());
    machine.qd_radps.resize(model.joints.size());
    machine.gear_angle_rad.resize(model.ground_tools.gears.size());
    machine.gear_rate_radps.resize(model.ground_tools.gears.size());
    SizeLoads(scenario, m, &machine);
  }
  state.obstacles.resize(scenario.obstacles.size());
  state.beds.resize(scenario.obstacles.size());
  return state;
}

template <typename InstantType>
std::size_t CountRow(InstantType& state) {
  std::size_t count = 0;
  ForRow(state, [&](const double&) { ++count; });
  return count;
}

}  // namespace

std::size_t StateColumns(const Scenario& scenario) {
  const Instant state = EmptyState(scenario);
  return CountRow(state);
}

void AppendStateRow(const Scenario& scenario, const Instant& state, std::vector<double>* rows) {
  const std::size_t before = rows->size();
  Instant padded = state;  // loads are empty until the first step
  for (std::size_t m = 0; m < padded.machines.size(); ++m) {
    SizeLoads(scenario, m, &padded.machines[m]);
  }
  ForRow(padded, [&](double number) { rows->push_back(number); });
  TERA_CHECK(rows->size() - before == StateColumns(scenario), rows->size(), before);
}

void AdvanceByRow(const Scenario& scenario, std::span<const double> row, double dt_s,
                  Instant* state) {
  const std::vector<MachineState> before = state->machines;
  std::size_t next = 0;
  ForRow(*state, [&](double& number) { number = row[next++]; });
  TERA_CHECK(next == row.size(), next, row.size());
  for (std::size_t m = 0; m < before.size(); ++m) {
    MachineState& machine = state->machines[m];
    const BodyState root = machine.links.front();
    machine.links = before[m].links;
    MoveLinks(scenario.machines[m].placement.model, {root.X_WB, root.v_WB_mps, root.w_WB_radps},
              machine.q_rad, machine.qd_radps, dt_s, &machine.links);
  }
}

std::vector<double> LinkMotions(const Instant& state) {
  std::vector<double> numbers;
  ForLinkMotions(state, [&](double number) { numbers.push_back(number); });
  return numbers;
}

bool StartFrom(const Scenario& scenario, const std::vector<double>& link_motions, Instant* state) {
  *state = EmptyState(scenario);
  std::size_t count = 0, next = 0;
  ForLinkMotions(*state, [&](const double&) { ++count; });
  if (count != link_motions.size()) return false;
  ForLinkMotions(*state, [&](double& number) { number = link_motions[next++]; });
  return true;
}

}  // namespace tera
