#pragma once

#include <span>
#include <vector>

#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// The numbers that determine the world, except its ground, from one step to the next. Per machine:
/// pose and velocities of the root, positions and rates of joints and running gear, loads of
/// shovels. Also poses of obstacles and loads of beds.
///
/// Omits   efforts, forces, levers, cylinders, sinkage and slip, which no sensor measures, and the
///         soils of a load.

/// Number of columns for a scenario.
std::size_t StateColumns(const Scenario& scenario);
/// Appends the row of `state`.
void AppendStateRow(const Scenario& scenario, const Instant& state, std::vector<double>* rows);
/// Advances `state` by a step of `dt_s` to the values of `row`. The time does not change.
void AdvanceByRow(const Scenario& scenario, std::span<const double> row, double dt_s,
                  Instant* state);

/// Motion of all links with accelerations: the input of the first step.
std::vector<double> LinkMotions(const Instant& state);
/// A state with this motion of the links. Returns false if the numbers do not fit the scenario.
bool StartFrom(const Scenario& scenario, const std::vector<double>& link_motions, Instant* state);

}  // namespace tera
