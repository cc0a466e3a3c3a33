#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/replay/gnss_replay.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The block of one receiver, or of both of a machine that has two: the measured positions of their
/// antennas, east, north and up, against those to which the measured motion carried them. What
/// exchanges or turns a pair shows in the two of them together.
///
/// Candidates are `gnss_lever_arm`, `position_datum`, `height_datum`, `multipath`, `clock_offset`,
/// `latency` and `filter_delay` of each, `antenna_swap` and, on one link, `antenna_yaw` of a pair.
///
/// Model   channels are relative to the documented antennas' positions, since relative to the
///         site's origin every error would look small. The slow part of a receiver's documented
///         noise is a nuisance, for an offset of its size is no datum; so is a centimetre of the
///         antenna's place on its link. Flexible regressor: heading, turning, velocity, attitude,
///         the raised part, time, and where the antenna was seconds before and after. Manoeuvres
///         are cut by how the first antenna moves and turns.
/// Omits   `float_jump`, which a receiver reports itself by its fix, `outliers`, `quantisation`,
///         `clock_drift`; noise that is slow and louder than documented, which passes for error.
///
/// A long recording is thinned: every n-th position is compared, 1200 of a receiver at most;
/// filters act at the receiver's own rate.
///
/// Channels are in the receivers' folders, "excavator1/gnss_left/east_m". None where one of the
/// receivers has fewer than 100 positions. Throws InputError where those of one come so unevenly
/// that most of a grid under them would be empty.
std::optional<ReplayBlock> MakeGnssBlock(const std::vector<SensorDescription>& receivers,
                                         GnssLog log, const std::string& machine);

}  // namespace tera
