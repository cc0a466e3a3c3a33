#pragma once

#include <cstddef>
#include <optional>

#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Makes the block of one joint or running gear. The block compares the measured rate with the rate
/// that the actuation chain predicts from the lever. The prediction uses the measured position and
/// load. `measured` is an index into log.measured.
///
/// Model   The grid has the median period of the samples. Each sample is assigned to the nearest
///         grid point, and its prediction is for the sample's own time. Gaps are samples at end
///         stops, and rates that repeat for over a second without a lever. If most samples repeat
///         the previous one exactly, only changed samples count.
///         The flexible regressor has the lever, its signed square, its excess over dead bands, and
///         its sign. All are repeated at up to twelve lags of at most 0.8 s. The flexible regressor
///         also has products of the lever with position, load, time and other levers. Nominal
///         numbers: rate at full lever, standard deviation 1.5 %; ratio of full effort to inertia,
///         standard deviation 7 %.
/// Omits   Pumps that deliver less than the demand.
///
/// Copies what it needs of `model` and `log`. Returns nothing if the axis has no lever or too few
/// samples.
std::optional<ReplayBlock> MakeAxisBlock(const MachineModel& model, const AxisLog& log,
                                         std::size_t measured);

/// Discrepancy of the replay of one axis, on the grid of the block of `log`: the rate in a
/// whole-machine simulation minus the rate of the actuation chain alone. Simulation and chain have
/// the same levers and the simulated positions. The discrepancy contains the pull of other joints
/// and the support of the ground.
///
/// `simulated` is a log of the simulation under the same levers, with error-free rates at the times
/// of `log`. After the end of the simulation, the discrepancy is 0. Returns an empty list if the
/// axis has no lever or too few samples.
std::vector<double> RateDiscrepancy(const MachineModel& model, const AxisLog& log,
                                    const AxisLog& simulated, std::size_t measured);

}  // namespace tera
