#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

// Channel types in dataset.yaml. A sensor kind that records rows may define its own type.
inline constexpr std::string_view kImuChannel = "imu", kGnssChannel = "gnss",
                                  kEncoderChannel = "encoder", kCameraChannel = "camera",
                                  kLidarChannel = "lidar", kTableChannel = "table",
                                  kPoseChannel = "pose";

/// Alternative of Measurement that a channel carries.
enum class ChannelForm { kRows, kPictures, kScans };

struct ChannelInfo {
  std::string path;  ///< folder of a sensor, such as "excavator1/imu_boom", or file of a table
  std::string type;  ///< as in dataset.yaml
  ChannelForm form = ChannelForm::kRows;
  std::optional<std::string> sensor_yaml;  ///< text of sensor.yaml; absent for a table
  std::vector<std::string> columns;        ///< columns of the rows, without t_ns
};

ChannelInfo ImuChannel(const std::string& folder, const std::string& sensor_yaml);
ChannelInfo GnssChannel(const std::string& folder, const std::string& sensor_yaml);
ChannelInfo EncoderChannel(const std::string& folder, const std::string& sensor_yaml,
                           const std::vector<EncoderAxis>& axes);

/// A table whose first column is t_ns, such as commands.csv or truth/<machine>/joints.csv.
ChannelInfo TableChannel(const std::string& file, const std::vector<std::string>& columns);
/// A pose file, such as truth/<machine>/pose.csv. Without velocities, the velocity columns are
/// absent.
ChannelInfo PoseChannel(const std::string& file, bool with_velocity = true);

}  // namespace tera
