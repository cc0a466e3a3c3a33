#pragma once

#include <optional>
#include <string>

#include "diagnose/replay/imu_replay.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Block of an inertial unit: three measured rates and three specific forces, against those of an
/// ideal unit on the link's measured motion. Candidates are `bias`, `scale`, `temperature_drift`,
/// `mount_rotation`, `axis_flip`, `imu_lever_arm` and the sensor's clock.
///
/// Model   a link that never turns is judged at rest. The recording is then cut into pieces of
///         time, and the candidates are those visible at rest: `bias`, `temperature_drift`,
///         `mount_rotation` and `axis_flip`. Measured poses may be delayed, and their map tilted
///         (measured_poses.h).
/// Omits   saturation, outliers, vibration.
///
/// `channel` is the sensor's folder in the recording, "excavator1/imu_boom". Channels are relative
/// to their mean without candidates, since relative to zero gravity any change would look small.
/// None with fewer than 100 intervals.
std::optional<ReplayBlock> MakeImuBlock(const SensorDescription& sensor, ImuLog log,
                                        const std::string& channel, bool poses_were_measured);

}  // namespace tera
