#pragma once

#include <cstddef>
#include <optional>

#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The block of one joint or gear of a machine: its measured rate against what the chain of
/// actuation makes of its lever at its measured positions and loads.
///
/// Model   the grid has the median period of the samples. A sample stands at the nearest place; its
///         prediction is for its own time. Gaps are samples at end stops and a rate that has
///         repeated itself for a second; where most samples repeat the one before bit for bit, only
///         the others count. Flexible regressor: the lever, its signed square, its excess over dead
///         bands and its sign, each at twelve lags up to 0.8 s; and the lever times position and
///         load. Nominal numbers: rate at full lever, full effort over inertia, known to 7 %.
/// Omits   pumps that do not deliver what is asked of them.
///
/// `measured` is an index into log.measured. Model and log are copied as far as they are needed.
/// None where the axis has no lever, or hardly a sample.
std::optional<ReplayBlock> MakeAxisBlock(const MachineModel& model, const AxisLog& log,
                                         std::size_t measured);

/// The replay's discrepancy of an axis's rate, on the grid of the block of `log`: its rate in a
/// simulation of the whole machine less what the chain of actuation makes of the same levers at the
/// simulated positions. Other joints that pull on this one and ground that holds it up show in it.
///
/// `simulated` is a log of the simulation under the same levers, with rates free of errors at the
/// times of `log`; beyond its end the discrepancy is 0. Empty where there is no block.
std::vector<double> RateDiscrepancy(const MachineModel& model, const AxisLog& log,
                                    const AxisLog& simulated, std::size_t measured);

}  // namespace tera
