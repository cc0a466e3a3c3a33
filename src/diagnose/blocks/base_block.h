#pragma once

#include <optional>

#include "diagnose/replay/base_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The block of a machine's base: its motion over the ground, forward, to the left and in yaw, by
/// its poses, against what the ground slot makes of the measured rates of its running gear.
///
/// Model   the grid has the median length of the log's intervals. Flexible regressor: both sides'
///         speeds, their magnitudes, and both times the slopes, at lags up to half a second.
///         Nominal numbers: how far from the middle of its tracks the machine turns, by its masses
///         (turning_centre.h) and, on a side slope, by friction; that far is one standard
///         deviation.
/// Omits   forces on tools; friction that depends on the place.
///
/// `name` stands before the channels' names: "excavator1/base". Poses that were measured may come
/// late, and some later than others (measured_poses.h). None where there is hardly an interval.
std::optional<ReplayBlock> MakeBaseBlock(const MachineModel& model, const BaseLog& log,
                                         const std::string& name, bool poses_were_measured);

/// The replay's discrepancy of the base's motion, a list for each channel on the grid of the block
/// of `log`: its motion in a simulation of the whole machine less what the ground slot makes of the
/// simulated rates of its gears. Slip of tracks on soil and rocking show in it.
///
/// `simulated` is a log of the simulation at the times of `log`; beyond its end the discrepancy is
/// 0. Empty where there is no block.
std::vector<std::vector<double>> MotionDiscrepancy(const MachineModel& model, const BaseLog& log,
                                                   const BaseLog& simulated);

}  // namespace tera
