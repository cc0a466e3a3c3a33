#pragma once

#include <span>
#include <vector>

#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// The numbers of one step from which the world but for its ground follows, given the step before:
/// of each machine the pose and the velocities of its root, positions and rates of joints and
/// running gear, loads of shovels; poses of obstacles; what lies in beds.
///
/// Omits  efforts, forces, levers, cylinders, sinkage and slip, which no sensor measures, and the
///        soils that a load is of.

/// How many there are of a scenario.
std::size_t StateColumns(const Scenario& scenario);
/// Appends those of `state`.
void AppendStateRow(const Scenario& scenario, const Instant& state, std::vector<double>* rows);
/// Moves `state` on by a step of `dt_s`, to where `row` has it. Time is left as it was.
void AdvanceByRow(const Scenario& scenario, std::span<const double> row, double dt_s,
                  Instant* state);

/// What the first step follows from: motion of all links, accelerations included.
std::vector<double> LinkMotions(const Instant& state);
/// A state in which links move so. False where the numbers are not those of the scenario.
bool StartFrom(const Scenario& scenario, const std::vector<double>& link_motions, Instant* state);

}  // namespace tera
