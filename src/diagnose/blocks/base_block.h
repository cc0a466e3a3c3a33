#pragma once

#include <optional>

#include "diagnose/replay/base_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The motion of a machine's base over the ground: forward, to the left and in yaw, as poses tell
/// it, against what the ground slot makes of the measured rates of its running gear.
///
/// Model   the grid has the median length of the log's intervals. Flexible regressor: both sides'
///         speeds, their magnitudes, and both by the slopes, now and up to half a second ago.
/// Omits   forces on tools; friction that depends on the place.
///
/// `name` stands before the channels' names: "excavator1/base". Poses that were measured may come
/// late, and some later than others (measured_poses.h). No block where there is hardly an interval.
std::optional<ReplayBlock> MakeBaseBlock(const MachineModel& model, const BaseLog& log,
                                         const std::string& name, bool poses_were_measured);

/// What the ground slot, over a simulation of the whole machine, leaves of the base's motion, a
/// list for each channel on the grid of the block of `log`: slip of tracks on soil, rocking.
///
/// `simulated` is a log of the simulation at the times of `log`; beyond its end nothing is left.
/// Empty where there is no block.
std::vector<std::vector<double>> MotionDiscrepancy(const MachineModel& model, const BaseLog& log,
                                                   const BaseLog& simulated);

}  // namespace tera
