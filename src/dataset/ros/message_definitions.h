#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dataset/ros/serializer.h"

/// The definitions of messages as texts that bags carry, so that readers need no package of ROS.

namespace tera::ros {

/// "sensor_msgs/msg/Imu" in ROS 2, "sensor_msgs/Imu" in ROS 1.
std::string FullTypeName(std::string_view type, WireForm form);

/// The definition of a type ("sensor_msgs/Imu"), and after it, each behind a line of equals signs
/// and its name, those of all types that it is made of.
std::string FullDefinition(std::string_view type, WireForm form);

/// The digest of a type by which ROS 1 tells whether two definitions are the same.
///
/// Model   MD5 of its constants, then its fields, a line each, in which the digest of a type that
/// is
///         itself a message stands in place of its name.
/// Source  "genmsg" of ROS 1, gentools.
std::string Md5Sum(std::string_view type);

/// The definition of a type alone, without what it is made of, as ROS 2 has it.
std::string_view DefinitionOf(std::string_view type);

/// The same, where the type is one of those that are known here.
std::optional<std::string_view> FindDefinition(std::string_view type);

/// The definition of a known type alone, in the names of either ROS.
std::string OwnDefinition(std::string_view type, WireForm form);

}  // namespace tera::ros
