#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/replay/gnss_replay.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Where receivers say that their antennas are against where the measured motion carried these:
/// east, north and up. One receiver, or both of a machine that has two: what exchanges or turns a
/// pair shows in the two of them.
///
/// Candidates are `gnss_lever_arm`, `position_datum`, `height_datum`, `multipath`, `clock_offset`,
/// `latency` and `filter_delay` of each, `antenna_swap` and, on one link, `antenna_yaw` of a pair.
///
/// Model   channels are less what they would be as documented, for a machine's way would make every
///         error look small. The slow part of a receiver's documented noise is a nuisance: an
///         offset of its size is no datum; so is a centimetre of the antenna's place on its link.
///         Flexible regressor: heading, turning, velocity, attitude, the raised part, time, and
///         where the antenna was seconds before and after. Manoeuvres are told apart by how the
///         first antenna moves and turns.
/// Omits   `float_jump`, which a receiver tells itself by its fix, `outliers`, `quantisation`,
///         `clock_drift`; noise that is slow and louder than documented, which passes for error.
///
/// Of a long recording every so many-th position is compared, 1200 at most of a receiver; what
/// filters does so at its own rate.
///
/// Channels are in the receivers' folders, "excavator1/gnss_left/east_m". Nothing where one of them
/// has fewer than 100 positions. Throws InputError where those of one come so unevenly that most of
/// a grid under them would be empty.
std::optional<ReplayBlock> MakeGnssBlock(const std::vector<SensorDescription>& receivers,
                                         GnssLog log, const std::string& machine);

}  // namespace tera
