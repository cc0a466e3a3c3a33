#pragma once

#include <string_view>

#include "dataset/ros/messages.h"
#include "dataset/ros/serializer.h"

/// Messages as bytes: their fields in the order of the ROS definitions, which ROS 1 and ROS 2 share
/// but for the header, whose number of ROS 1 is always 0 here, and the place of a grid map's
/// header.

namespace tera::ros {

void Put(const Clock& message, Serializer* out);
void Put(const Float64& message, Serializer* out);
void Put(const PoseStamped& message, Serializer* out);
void Put(const TfMessage& message, Serializer* out);
void Put(const Odometry& message, Serializer* out);
void Put(const JointState& message, Serializer* out);
void Put(const Imu& message, Serializer* out);
void Put(const NavSatFix& message, Serializer* out);
void Put(const Image& message, Serializer* out);
void Put(const CompressedImage& message, Serializer* out);
void Put(const CameraInfo& message, Serializer* out);
void Put(const PointCloud2& message, Serializer* out);
void Put(const GridMap& message, Serializer* out);
/// Its header names no frame.
void Put(const DeltaCan& message, Serializer* out);

/// "sensor_msgs/Imu"
template <typename Message>
struct TypeName;
template <>
struct TypeName<Clock> {
  static constexpr std::string_view value = "rosgraph_msgs/Clock";
};
template <>
struct TypeName<Float64> {
  static constexpr std::string_view value = "std_msgs/Float64";
};
template <>
struct TypeName<PoseStamped> {
  static constexpr std::string_view value = "geometry_msgs/PoseStamped";
};
template <>
struct TypeName<TfMessage> {
  static constexpr std::string_view value = "tf2_msgs/TFMessage";
};
template <>
struct TypeName<Odometry> {
  static constexpr std::string_view value = "nav_msgs/Odometry";
};
template <>
struct TypeName<JointState> {
  static constexpr std::string_view value = "sensor_msgs/JointState";
};
template <>
struct TypeName<Imu> {
  static constexpr std::string_view value = "sensor_msgs/Imu";
};
template <>
struct TypeName<NavSatFix> {
  static constexpr std::string_view value = "sensor_msgs/NavSatFix";
};
template <>
struct TypeName<Image> {
  static constexpr std::string_view value = "sensor_msgs/Image";
};
template <>
struct TypeName<CompressedImage> {
  static constexpr std::string_view value = "sensor_msgs/CompressedImage";
};
template <>
struct TypeName<CameraInfo> {
  static constexpr std::string_view value = "sensor_msgs/CameraInfo";
};
template <>
struct TypeName<PointCloud2> {
  static constexpr std::string_view value = "sensor_msgs/PointCloud2";
};
template <>
struct TypeName<GridMap> {
  static constexpr std::string_view value = "grid_map_msgs/GridMap";
};
template <>
struct TypeName<DeltaCan> {
  static constexpr std::string_view value = "tera_msgs/DeltaCAN";
};

}  // namespace tera::ros
