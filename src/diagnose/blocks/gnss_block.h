#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/replay/gnss_replay.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Makes the block of one GNSS receiver or of a pair. Measured antenna positions (east, north, up)
/// are compared with positions from the measured motion of the links. An exchange or rotation of a
/// pair is visible only in both receivers together.
///
/// Candidates of each receiver: `gnss_lever_arm`, `position_datum`, `height_datum`, `multipath`
/// with a boom, `clock_offset`, `latency` and `filter_delay`. A pair also has `antenna_swap` and,
/// on one link, `antenna_yaw`.
///
/// Model   Channels are relative to the positions of the documented antennas. Relative to the
///         site's origin, every error would look small. Nuisances are the slow part of the
///         receiver's documented noise, and 1 cm of the antenna's position on its link. The
///         flexible regressor has heading, yaw rate, velocity, attitude, height of the boom, time,
///         and the antenna's displacement over several delays. The motion and yaw rate of the first
///         antenna separate the manoeuvres.
///         Long recordings are thinned to every n-th position, at most 1200 per receiver. Filters
///         act at the receiver's own rate.
/// Omits   `float_jump`, which a receiver reports by its fix; `outliers`, `quantisation`,
///         `clock_drift`. Slow noise above the documented level counts as error.
///
/// Channels are named by the receivers' folders, "excavator1/gnss_left/east_m". Returns nothing if
/// a receiver has fewer than 100 positions. Throws InputError if uneven positions would leave most
/// of the grid empty.
std::optional<ReplayBlock> MakeGnssBlock(const std::vector<SensorDescription>& receivers,
                                         GnssLog log, const std::string& machine);

}  // namespace tera
