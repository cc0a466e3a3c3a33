#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/replay/gnss_replay.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Block of one receiver, or of a pair: measured antenna positions (east, north, up) against those
/// that follow from the measured motion. Exchange or rotation of a pair shows only in both
/// together.
///
/// Candidates of each receiver: `gnss_lever_arm`, `position_datum`, `height_datum`, `multipath`,
/// `clock_offset`, `latency` and `filter_delay`. A pair also has `antenna_swap` and, on one link,
/// `antenna_yaw`.
///
/// Model   channels are relative to the documented antennas' positions, since any error would look
///         small relative to the site's origin. Nuisances are the slow part of a receiver's
///         documented noise, whose size is no datum, and a centimetre of the antenna's place on its
///         link. Flexible regressor: heading, yaw rate, velocity, attitude, the raised part, time,
///         and the antenna's positions seconds before and after. The first antenna's motion and
///         rotation separate the manoeuvres.
/// Omits   `float_jump`, which a receiver reports by its fix, `outliers`, `quantisation`,
///         `clock_drift`; slow noise above the documented level, which counts as error.
///
/// A long recording is thinned to every n-th position, at most 1200 of a receiver. Filters act at
/// the receiver's own rate.
///
/// Channels are in the receivers' folders, "excavator1/gnss_left/east_m". None if a receiver has
/// fewer than 100 positions. Throws InputError if a receiver's positions are so uneven that most of
/// its grid would be empty.
std::optional<ReplayBlock> MakeGnssBlock(const std::vector<SensorDescription>& receivers,
                                         GnssLog log, const std::string& machine);

}  // namespace tera
