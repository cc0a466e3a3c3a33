#pragma once

#include <cstddef>
#include <optional>

#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Block of one joint or gear of a machine: its measured rate against that of the actuation chain
/// for its lever. Positions and loads are the measured ones.
///
/// Model   the grid has the samples' median period. A sample is at the nearest grid point; its
///         prediction is for its own time. Gaps: samples at end stops, and rates that repeat for a
///         second. If most samples repeat the previous one bit for bit, only the others are
///         measurements. Flexible regressor: the lever, its signed square, its excess over dead
///         bands and its sign, each at twelve lags up to 0.8 s; the lever times position and load.
///         Nominal numbers: rate at full lever, full effort over inertia, known to 7 %.
/// Omits   pumps that deliver less than their demand.
///
/// `measured` is an index into log.measured. Copies what it needs of model and log. None if the
/// axis has no lever or too few samples.
std::optional<ReplayBlock> MakeAxisBlock(const MachineModel& model, const AxisLog& log,
                                         std::size_t measured);

/// Replay's discrepancy of an axis's rate, on the grid of the block of `log`. It is the rate in a
/// simulation of the whole machine, minus that of the actuation chain under the same levers at the
/// simulated positions. It contains the pull of other joints and the support of the ground.
///
/// `simulated` is a log of the simulation under the same levers, with error-free rates at the times
/// of `log`. After its end the discrepancy is 0. Empty without a block.
std::vector<double> RateDiscrepancy(const MachineModel& model, const AxisLog& log,
                                    const AxisLog& simulated, std::size_t measured);

}  // namespace tera
