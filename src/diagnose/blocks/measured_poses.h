#pragma once

#include <span>
#include <string_view>

#include "core/motion.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Poses of a real recording are measurements themselves, by registration of scans. They are
/// delayed, so that other measurements seem early. Their map starts with the machine's attitude,
/// which need not be level, so that gravity seems to come from the side.
///
/// Frames  M map of the poses; L level, z up. They share their origin and, except for roll and
///         pitch, their axes.
/// Model   candidates of the target "poses". `latency`: stamps are later than the measurement; a
///         sensor whose clock is behind shows the same. `arrival_stamps`: stamps are uneven times
///         of arrival, while the poses were measured periodically (pose_times.h). `mount_rotation`:
///         roll and pitch of the map from level.
/// Omits   smoothing of poses by a filter; a map that bends.
inline constexpr std::string_view kPoses = "poses";

/// Mechanisms of measured poses alone; no simulation has them.
std::span<const Mechanism> PoseMechanisms();

Candidate PoseLatencyCandidate();
Candidate ArrivalStampsCandidate();
Candidate MapTiltCandidate();

/// Latency of poses under a structure; 0 without such a term.
double PoseLatency_s(const Structure& terms);

bool HasArrivalStamps(const Structure& terms);

/// R_ML, the level's axes in the map, under a structure.
Mat3 MapTilt(const Structure& terms);

/// The structure without terms of poses.
Structure WithoutPoseTerms(Structure terms);

}  // namespace tera
