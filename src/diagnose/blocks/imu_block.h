#pragma once

#include <optional>
#include <string>

#include "diagnose/replay/imu_replay.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The block of an inertial unit: three measured rates and three specific forces against those that
/// an ideal unit would have measured on the link as that was measured to move. Candidates are
/// `bias`, `scale`, `temperature_drift`, `mount_rotation`, `axis_flip`, `imu_lever_arm` and the
/// sensor's clock.
///
/// Model   a link that never turned is judged at rest: the recording is cut into pieces of time,
///         and candidates are those that a resting unit shows, `bias`, `temperature_drift`,
///         `mount_rotation` and `axis_flip`. Poses that were measured may come late, and their map
///         may be tilted (measured_poses.h).
/// Omits   saturation, outliers, vibration.
///
/// `channel` is the sensor's folder in the recording, "excavator1/imu_boom". Channels are relative
/// to their mean without candidates, since relative to zero gravity would make every change look
/// small. None where there are fewer than 100 intervals.
std::optional<ReplayBlock> MakeImuBlock(const SensorDescription& sensor, ImuLog log,
                                        const std::string& channel, bool poses_were_measured);

}  // namespace tera
