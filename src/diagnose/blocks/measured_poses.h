#pragma once

#include <span>
#include <string_view>

#include "core/motion.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Poses that a recording holds were measured too, where nothing simulated them. Registration gives
/// them late: what is compared with them then seems early. And its map begins as the machine stood,
/// which need not be level: gravity then seems to come from the side.
///
/// Frames  the map, in which the poses are; the level, whose z is up. They share their origin and,
///         but for roll and pitch, their axes.
/// Model   suspects of the target "poses". `latency`: stamped so long after they were; a sensor
///         whose clock is behind by as much shows the same. `arrival_stamps`: stamped as they
///         arrive, which is not evenly, though they were measured once a period (pose_times.h).
///         `mount_rotation`, roll and pitch of the map from the level.
/// Omits   that a filter makes them smooth as well; a map that bends.

inline constexpr std::string_view kPoses = "poses";

/// What acts on measured poses alone, and on nothing that is simulated.
std::span<const Mechanism> PoseMechanisms();

Suspect LatePoses();
Suspect ArrivalStamps();
Suspect TiltedMap();

/// By how much a structure has the poses late.
double LatenessOfPoses_s(const Structure& terms);

bool HasArrivalStamps(const Structure& terms);

/// The level's axes to the map's, as a structure has them.
Mat3 TiltOfMap(const Structure& terms);

/// The terms that are of something else.
Structure BesidesPoses(Structure terms);

}  // namespace tera
