#pragma once

#include <optional>
#include <string>

#include "diagnose/replay/imu_replay.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Makes the block of an inertial unit. Three measured rates and three specific forces are compared
/// with those of an ideal unit on the link's measured motion. Candidates are `bias`, `scale`,
/// `temperature_drift`, `mount_rotation`, `axis_flip`, `imu_lever_arm`, `clock_offset`, `latency`
/// and `filter_delay`.
///
/// Model   If the link never turns, the recording is cut into pieces of time instead of manoeuvres.
///         Only the candidates that are visible at rest remain: `bias`, `temperature_drift`,
///         `mount_rotation` and `axis_flip`. For a moving link, measured poses add two candidates:
///         latency of the poses and tilt of the poses' map (measured_poses.h).
/// Omits   Saturation, outliers, vibration.
///
/// `channel` is the sensor's folder in the recording, "excavator1/imu_boom". Forces are relative to
/// the mean predicted force without candidates. Relative to zero, gravity would make every change
/// look small. Returns nothing with fewer than 100 intervals.
std::optional<ReplayBlock> MakeImuBlock(const SensorDescription& sensor, ImuLog log,
                                        const std::string& channel, bool poses_were_measured);

}  // namespace tera
