#pragma once

#include <span>
#include <string_view>

#include "core/motion.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The poses of a recording that nothing simulated were measured too, by registration of scans.
/// They come late, so that what is compared with them seems early. Their map begins as the machine
/// stood, which need not be level, so that gravity seems to come from the side.
///
/// Frames  M the map, in which the poses are; L level, with z up. They share their origin and, but
///         for roll and pitch, their axes.
/// Model   candidates of the target "poses". `latency`: poses are stamped so long after they were
///         measured; a sensor whose clock is behind by as much shows the same. `arrival_stamps`:
///         they are stamped as they arrive, which is not evenly, though they were measured once a
///         period (pose_times.h). `mount_rotation`: roll and pitch of the map from level.
/// Omits   that a filter makes poses smooth as well; a map that bends.
inline constexpr std::string_view kPoses = "poses";

/// Mechanisms that act on measured poses alone, and on nothing that is simulated.
std::span<const Mechanism> PoseMechanisms();

Candidate PoseLatencyCandidate();
Candidate ArrivalStampsCandidate();
Candidate MapTiltCandidate();

/// The latency of poses under a structure; 0 where it has no such term.
double PoseLatency_s(const Structure& terms);

bool HasArrivalStamps(const Structure& terms);

/// R_ML, the level's axes in the map, under a structure.
Mat3 MapTilt(const Structure& terms);

/// The structure without the terms that act on poses.
Structure WithoutPoseTerms(Structure terms);

}  // namespace tera
