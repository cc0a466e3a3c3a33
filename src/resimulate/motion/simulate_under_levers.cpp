#include "resimulate/motion/simulate_under_levers.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "sim/operators/lever_replay.h"
#include "sim/simulation.h"

namespace tera {
namespace {

std::unique_ptr<Operator> DriverOf(const MachineModel& model, const TableRecording& levers,
                                   TimeNs zero_ns) {
  CommandTable table;
  std::vector<int> lever_of_column;
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < levers.columns.size(); ++c) {
    const int lever = model.LeverIndex(levers.columns[c]);
    if (lever < 0) continue;
    columns.push_back(c);
    lever_of_column.push_back(lever);
  }
  for (std::size_t r = 0; r < levers.rows.size(); ++r) {
    table.t_ns.push_back(levers.t_ns[r] - zero_ns);
    std::vector<double> row;
    for (const std::size_t c : columns) row.push_back(std::clamp(levers.rows[r][c], -1.0, 1.0));
    table.rows.push_back(std::move(row));
  }
  return std::make_unique<LeverReplay>(LeverReplayPlan{
      std::make_shared<const CommandTable>(std::move(table)), std::move(lever_of_column)});
}

SimulatedCourse::Step StepOf(const MachineState& state) {
  SimulatedCourse::Step step{state.q_rad, state.qd_radps, state.links.front().X_WB};
  const auto append = [](const std::vector<double>& more, std::vector<double>* list) {
    list->insert(list->end(), more.begin(), more.end());
  };
  append(state.gear_angle_rad, &step.position_rad);
  append(state.gear_rate_radps, &step.rate_radps);
  return step;
}

}  // namespace

SimulatedCourse SimulateUnderLevers(const Scenario& scenario, std::size_t machine,
                                    const TableRecording& levers, const CourseSpan& span) {
  Operators operators = OperatorsOf(scenario);
  operators[machine] = DriverOf(scenario.machines[machine].placement.model, levers, span.zero_ns);
  SimulatedCourse course{
      .zero_ns = span.zero_ns, .step_s = 1 / scenario.physics_rate_hz, .steps = {}};
  Simulation simulation(scenario, std::move(operators));
  course.steps.push_back(StepOf(simulation.state().machines[machine]));
  const auto steps = static_cast<std::int64_t>(std::ceil(span.until_s * scenario.physics_rate_hz));
  for (std::int64_t k = 0; k < steps; ++k) {
    simulation.Step();
    course.steps.push_back(StepOf(simulation.state().machines[machine]));
  }
  return course;
}

}  // namespace tera
