#pragma once

#include <string>
#include <string_view>

#include "core/types/label_channels.h"

/// Names in ROS: topics and frames below the machine's name.

namespace tera::ros {

/// The world W: local east-north-up about the site's origin.
inline constexpr const char* kWorldFrame = "map";
/// Suffix of a camera's optical frame.
inline constexpr const char* kOpticalEnding = "_optical";

/// "/excavator1/odom"
std::string TopicOf(const std::string& machine, const std::string& topic);

/// The frame of a link or a sensor, "excavator1/boom".
std::string FrameOf(const std::string& machine, const std::string& part);

/// The name of a camera's optical frame, x right, y down, z forward:
/// "excavator1/camera_front_optical".
std::string OpticalFrameOf(const std::string& machine, const std::string& camera);

/// A sensor's topic below its machine: its own name, with `gps` in place of a leading `gnss`, as
/// usual in ROS.
std::string SensorTopicOf(const std::string& sensor, std::string_view type);

/// A valid ROS name. Characters other than letters, digits, '_' and '/' become '_', and a word that
/// begins with a digit gets a leading '_'.
std::string AllowedName(std::string_view name);

// Topics of a sensor, below its own; kSensorItself: the sensor's own topic.
inline const std::string kSensorItself;
inline const std::string kFixTopic = "fix";
inline const std::string kPointsTopic = "points";
inline const std::string kColourTopic = "image_raw", kCameraInfoTopic = "camera_info";
inline const std::string kDepthTopic = "depth/image_raw", kDepthInfoTopic = "depth/camera_info";
/// "semantic/image_raw"
std::string LabelTopic(const LabelChannel& channel);

}  // namespace tera::ros
