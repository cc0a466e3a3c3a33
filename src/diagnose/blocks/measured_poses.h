#pragma once

#include <span>
#include <string_view>

#include "core/motion.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Poses of a real recording are measurements, for example from scan registration. Delayed poses
/// make other measurements appear early. The axes of the poses' map follow the machine's initial
/// attitude, which need not be level. Gravity then appears tilted.
///
/// Frames  M map of the poses; L level frame, z up. M and L have the same origin. The axes of M and
///         L differ only in roll and pitch.
/// Model   Candidates with the target "poses". `latency`: stamps are later than the measurement. A
///         sensor whose clock is behind has the same effect. `arrival_stamps`: stamps are uneven
///         times of arrival of periodic measurements (pose_times.h). `mount_rotation`: roll and
///         pitch of the map relative to level.
/// Omits   Smoothing of poses by a filter; deformation of the map.
inline constexpr std::string_view kPoses = "poses";

/// Mechanisms that only measured poses have. No simulation has them.
std::span<const Mechanism> PoseMechanisms();

Candidate PoseLatencyCandidate();
Candidate ArrivalStampsCandidate();
Candidate MapTiltCandidate();

/// Latency of poses under a structure; 0 without a latency term.
double PoseLatency_s(const Structure& terms);

bool HasArrivalStamps(const Structure& terms);

/// R_ML, the rotation of the level frame in the map, under a structure.
Mat3 MapTilt(const Structure& terms);

/// The structure without terms of the target "poses".
Structure WithoutPoseTerms(Structure terms);

}  // namespace tera
