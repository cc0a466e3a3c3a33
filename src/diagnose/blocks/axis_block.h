#pragma once

#include <cstddef>
#include <optional>

#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// One joint or gear of a machine: its measured rate against what the chain of actuation makes of
/// its lever at its measured positions and loads.
///
/// Model   the grid has the median period of the samples; a sample stands at the nearest place, its
///         prediction is for its own time. Samples at end stops are gaps, and so is a rate that has
///         repeated itself for a second; where most samples are the one before, bit for bit, only
///         the others count. Flexible regressor: the lever, its square with its sign, what is left
///         of it beyond dead bands and its sign, each through a filter of twelve lags up to 0.8 s;
///         and the lever by position and by load. Nominal: full effort over inertia, known to 7 %.
/// Omits   pumps that do not deliver what is asked of them.
///
/// `measured` is an index into log.measured. Model and log are copied as far as they are needed. No
/// block where the axis has no lever, or hardly a sample.
std::optional<ReplayBlock> MakeAxisBlock(const MachineModel& model, const AxisLog& log,
                                         std::size_t measured);

/// What the chain of actuation, over a simulation of the whole machine, leaves of its rates, on the
/// grid of the block of `log`: other joints that pull on this one, ground that holds it up.
///
/// `simulated` is a log of the simulation under the same levers, with rates free of errors at the
/// times of `log`; beyond its end nothing is left. Empty where there is no block.
std::vector<double> RateDiscrepancy(const MachineModel& model, const AxisLog& log,
                                    const AxisLog& simulated, std::size_t measured);

}  // namespace tera
