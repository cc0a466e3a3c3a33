#include "dataset/format/channel.h"

#include "core/types/sample_rows.h"

namespace tera {

ChannelInfo ImuChannel(const std::string& folder, const std::string& sensor_yaml) {
  return {folder, std::string(kImuChannel), ChannelForm::kRows, sensor_yaml, ImuColumns()};
}

ChannelInfo GnssChannel(const std::string& folder, const std::string& sensor_yaml) {
  return {folder, std::string(kGnssChannel), ChannelForm::kRows, sensor_yaml, GnssColumns()};
}

ChannelInfo EncoderChannel(const std::string& folder, const std::string& sensor_yaml,
                           const std::vector<EncoderAxis>& axes) {
  return {folder, std::string(kEncoderChannel), ChannelForm::kRows, sensor_yaml,
          EncoderColumns(axes)};
}

ChannelInfo TableChannel(const std::string& file, const std::vector<std::string>& columns) {
  return {file, std::string(kTableChannel), ChannelForm::kRows, std::nullopt, columns};
}

ChannelInfo PoseChannel(const std::string& file, bool with_velocity) {
  return {file, std::string(kPoseChannel), ChannelForm::kRows, std::nullopt,
          PoseColumns(with_velocity)};
}

}  // namespace tera
