#pragma once

#include <span>
#include <vector>

#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// The numbers that describe the bodies of a world at one step. For each machine: pose and velocity
/// of the root, positions and rates of joints and running gear, loads of shovels. Also poses of
/// obstacles and loads of beds. The ground is not included.
///
/// Omits   efforts, forces, levers, cylinders, sinkage, slip and the soils of a load: no sensor
///         measures them.

/// Number of columns of a row.
std::size_t StateColumns(const Scenario& scenario);
/// Appends the row of `state`.
void AppendStateRow(const Scenario& scenario, const Instant& state, std::vector<double>* rows);
/// Changes `state` by a step of `dt_s` to the values of `row`. Does not change its time.
void AdvanceByRow(const Scenario& scenario, std::span<const double> row, double dt_s,
                  Instant* state);

/// Motion of all links including accelerations, as the first step needs it.
std::vector<double> LinkMotions(const Instant& state);
/// Creates a state from the output of LinkMotions. Returns false if the numbers do not fit the
/// scenario.
bool StartFrom(const Scenario& scenario, const std::vector<double>& link_motions, Instant* state);

}  // namespace tera
