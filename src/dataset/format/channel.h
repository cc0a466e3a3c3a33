#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

// Channel types in dataset.yaml. Sensor kinds whose samples are rows may add their own.
inline constexpr std::string_view kImuChannel = "imu", kGnssChannel = "gnss",
                                  kEncoderChannel = "encoder", kCameraChannel = "camera",
                                  kLidarChannel = "lidar", kTableChannel = "table",
                                  kPoseChannel = "pose";

/// The alternative of Measurement that a channel carries.
enum class ChannelForm { kRows, kPictures, kScans };

/// A channel without its measurements.
struct ChannelInfo {
  std::string path;  ///< folder of a sensor, "excavator1/imu_boom"; file of a table
  std::string type;  ///< as in dataset.yaml
  ChannelForm form = ChannelForm::kRows;
  std::optional<std::string> sensor_yaml;  ///< text of SensorYaml; none for tables
  std::vector<std::string> columns;        ///< row columns without t_ns
};

// Channels of sensors.
ChannelInfo ImuChannel(const std::string& folder, const std::string& sensor_yaml);
ChannelInfo GnssChannel(const std::string& folder, const std::string& sensor_yaml);
ChannelInfo EncoderChannel(const std::string& folder, const std::string& sensor_yaml,
                           const std::vector<EncoderAxis>& axes);

/// Any table with a leading t_ns: commands.csv, truth/<machine>/joints.csv.
ChannelInfo TableChannel(const std::string& file, const std::vector<std::string>& columns);
/// truth/<machine>/pose.csv. A real reference without velocities omits their columns.
ChannelInfo PoseChannel(const std::string& file, bool with_velocity = true);

}  // namespace tera
