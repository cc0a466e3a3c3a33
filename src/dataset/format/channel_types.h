#pragma once

#include <array>
#include <string_view>

#include "dataset/format/channel.h"

namespace tera {

/// A type of channel that this library reads itself.
struct ChannelType {
  std::string_view name;
  ChannelForm form;
  bool is_sensor;
};
inline constexpr std::array<ChannelType, 7> kChannelTypes = {
    {{kImuChannel, ChannelForm::kRows, true},
     {kGnssChannel, ChannelForm::kRows, true},
     {kEncoderChannel, ChannelForm::kRows, true},
     {kCameraChannel, ChannelForm::kPictures, true},
     {kLidarChannel, ChannelForm::kScans, true},
     {kTableChannel, ChannelForm::kRows, false},
     {kPoseChannel, ChannelForm::kRows, false}}};

}  // namespace tera
