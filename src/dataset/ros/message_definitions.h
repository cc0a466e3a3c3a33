#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dataset/ros/serializer.h"

/// Message definitions as text. Bags contain them, so that readers need no ROS packages.

namespace tera::ros {

/// Type name: "sensor_msgs/msg/Imu" in ROS 2, "sensor_msgs/Imu" in ROS 1.
std::string FullTypeName(std::string_view type, WireForm form);

/// Definition of a type such as "sensor_msgs/Imu", followed by the definitions of all types that it
/// contains. Each of these is preceded by a line of equals signs and a line with its name.
std::string FullDefinition(std::string_view type, WireForm form);

/// Digest by which ROS 1 compares definitions.
///
/// Model   MD5 of the constants and then the fields, one per line. For a field whose type is a
///         message, the digest of that type replaces its name.
/// Source  "genmsg" of ROS 1, gentools.
std::string Md5Sum(std::string_view type);

/// ROS 2 definition of a type, without the types that it contains.
std::string_view DefinitionOf(std::string_view type);

/// As DefinitionOf; nullopt for an unknown type.
std::optional<std::string_view> FindDefinition(std::string_view type);

/// Definition of a type in ROS 1 or ROS 2 notation, without the types that it contains.
std::string OwnDefinition(std::string_view type, WireForm form);

}  // namespace tera::ros
