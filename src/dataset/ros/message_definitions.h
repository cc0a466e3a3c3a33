#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dataset/ros/serializer.h"

/// Message definitions as texts for bags, so that readers need no ROS packages.

namespace tera::ros {

/// "sensor_msgs/msg/Imu" in ROS 2, "sensor_msgs/Imu" in ROS 1.
std::string FullTypeName(std::string_view type, WireForm form);

/// The definition of a type ("sensor_msgs/Imu"), followed by those of all its component types, each
/// after a line of equals signs and its name.
std::string FullDefinition(std::string_view type, WireForm form);

/// The digest by which ROS 1 compares definitions of a type.
///
/// Model   MD5 of its constants, then its fields, one per line. The digest of a field's message
///         type replaces its name.
/// Source  "genmsg" of ROS 1, gentools.
std::string Md5Sum(std::string_view type);

/// The ROS 2 definition of a type alone, without its component types.
std::string_view DefinitionOf(std::string_view type);

/// The same for a known type, else nothing.
std::optional<std::string_view> FindDefinition(std::string_view type);

/// The definition of a known type alone, in the names of ROS 1 or ROS 2.
std::string OwnDefinition(std::string_view type, WireForm form);

}  // namespace tera::ros
