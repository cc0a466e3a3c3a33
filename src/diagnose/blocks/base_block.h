#pragma once

#include <optional>

#include "diagnose/replay/base_log.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Makes the block of a machine's base. Measured poses give its motion over the ground (forward,
/// left, yaw). The simulator's track model (BaseReplay) predicts this motion from the measured gear
/// rates.
///
/// Model   The grid has the median length of the log's intervals. The flexible regressor has the
///         mean and half the difference of both sides' speeds, with their magnitudes and their
///         products with the slopes. All columns are repeated at lags up to 0.5 s. Nominal numbers
///         shift the turning centre from the middle of the tracks: by the machine's masses
///         (turning_centre.h) and, on a side slope, by friction. Each shift is one standard
///         deviation. Further nominal numbers are changes of the forward speed where firm or loose
///         ground limits the machine's acceleration.
/// Omits   Forces on tools; friction that varies with place.
///
/// `name` prefixes the channels' names: "excavator1/base". Measured poses may be delayed, some more
/// than others (measured_poses.h). Returns nothing with fewer than 100 intervals.
std::optional<ReplayBlock> MakeBaseBlock(const MachineModel& model, const BaseLog& log,
                                         const std::string& name, bool poses_were_measured);

/// Discrepancy of the replay of the base's motion: the motion in a whole-machine simulation minus
/// the motion of the track model alone. Both motions have the simulated gear rates. Returns one
/// list per channel, on the grid of the block of `log`. The discrepancy contains slip on soil and
/// rocking.
///
/// `simulated` is a log of the simulation at the times of `log`. After the end of the simulation,
/// the discrepancy is 0. Returns an empty list with too few intervals.
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
