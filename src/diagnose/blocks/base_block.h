#pragma once

#include <optional>

#include "diagnose/replay/base_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Block of a machine's base: its motion over the ground (forward, left, yaw) by measured poses,
/// against that of the ground slot for the measured gear rates.
///
/// Model   the grid has the median length of the log's intervals. Flexible regressor: both sides'
///         speeds, their magnitudes, and both times the slopes, at lags up to half a second.
///         Nominal numbers: the distance of the turning centre from the middle of the tracks, by
///         the machine's masses (turning_centre.h) and, on a side slope, by friction. The distance
///         is one standard deviation.
/// Omits   forces on tools; friction that varies with place.
///
/// `name` prefixes the channels' names: "excavator1/base". Measured poses may be delayed, some more
/// than others (measured_poses.h). None with too few intervals.
std::optional<ReplayBlock> MakeBaseBlock(const MachineModel& model, const BaseLog& log,
                                         const std::string& name, bool poses_were_measured);

/// Replay's discrepancy of the base's motion, a list for each channel on the grid of the block of
/// `log`. It is the motion in a simulation of the whole machine, minus that of the ground slot for
/// the simulated gear rates. It contains slip on soil and rocking.
///
/// `simulated` is a log of the simulation at the times of `log`. After its end the discrepancy is
/// 0. Empty without a block.
std::vector<std::vector<double>> MotionDiscrepancy(const MachineModel& model, const BaseLog& log,
                                                   const BaseLog& simulated);

/// Allows a constant heading error of a base whose motion is measured, due to antennas or maps. A
/// machine that drives straight then seems to drift sideways.
///
/// Model   a nominal number of the sideways speed: -heading times measured forward speed, for small
///         angles. Half of `tolerance_rad` is one standard deviation, so that the bound is the
///         tolerance (Likelihood). `base` is the block of MakeBaseBlock.
/// Omits   its effect on the forward speed, a thousandth of it.
void LetHeadingErr(double tolerance_rad, ReplayBlock* base);

}  // namespace tera
