#pragma once

#include <string>
#include <string_view>

#include "core/types/label_channels.h"

/// Names of ROS topics and frames. They begin with the name of the machine.

namespace tera::ros {

/// World frame W: local east-north-up at the site's origin.
inline constexpr const char* kWorldFrame = "map";
/// Suffix of optical frames.
inline constexpr const char* kOpticalEnding = "_optical";

/// Topic of a machine, such as "/excavator1/odom".
std::string TopicOf(const std::string& machine, const std::string& topic);

/// Frame of a link or sensor, such as "excavator1/boom".
std::string FrameOf(const std::string& machine, const std::string& part);

/// Optical frame of a camera (x right, y down, z forward), such as
/// "excavator1/camera_front_optical".
std::string OpticalFrameOf(const std::string& machine, const std::string& camera);

/// Topic of a sensor, relative to its machine. It is the sensor's name, with a leading `gnss`
/// replaced by `gps`, as is usual in ROS.
std::string SensorTopicOf(const std::string& sensor, std::string_view type);

/// A valid ROS name. A character other than letters, digits, '_' and '/' becomes '_'. A word that
/// begins with a digit gets the prefix '_'.
std::string AllowedName(std::string_view name);

// Topics of a sensor, relative to the sensor's topic. kSensorItself is the sensor's topic itself.
inline const std::string kSensorItself;
inline const std::string kFixTopic = "fix";
inline const std::string kPointsTopic = "points";
inline const std::string kColourTopic = "image_raw", kCameraInfoTopic = "camera_info";
inline const std::string kDepthTopic = "depth/image_raw", kDepthInfoTopic = "depth/camera_info";
/// Topic of a label channel, such as "semantic/image_raw".
std::string LabelTopic(const LabelChannel& channel);

}  // namespace tera::ros
