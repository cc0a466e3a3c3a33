#pragma once

#include <optional>
#include <string>

#include "diagnose/replay/imu_replay.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Compares what an inertial unit measured with what it would have on the link as that was measured
/// to move: three rates and three specific forces. Candidates are `bias`, `scale`,
/// `temperature_drift`, `mount_rotation`, `axis_flip`, `imu_lever_arm` and the sensor's clock.
///
/// Model   a link that never turned is judged at rest: the recording is cut into pieces of time,
///         and candidates are those that a standing unit shows, `bias`, `temperature_drift`,
///         `mount_rotation` and `axis_flip`. Poses that were measured may come late,
///         and their map may lean (measured_poses.h).
///
/// `channel` is the sensor's folder in the recording, "excavator1/imu_boom". Channels are less what
/// they would show on average without candidates, for gravity would make every change look small.
/// Nothing where there are fewer than 100 intervals. Omits saturation, outliers, vibration.
std::optional<ReplayBlock> MakeImuBlock(const SensorDescription& sensor, ImuLog log,
                                        const std::string& channel, bool poses_were_measured);

}  // namespace tera
