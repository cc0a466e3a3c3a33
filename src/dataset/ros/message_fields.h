#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dataset/ros/messages.h"

/// Fields of the messages. One description serves serialisation, deserialisation and message
/// definitions.
///
/// Model   `Fields(visitor, message)` calls visitor(name, value) for each field in the order of the
///         ROS definition, and visitor.Constant(line) for each constant. ROS 1 and ROS 2 have the
///         same order, with two exceptions: the sequence number in the header, and the place of a
///         grid map's header. A value is a number, a text, a list, or a part with fields of its
///         own.
/// Source  common_interfaces, geometry2, rcl_interfaces, branch humble; grid_map_msgs; for TERA's
///         own message examples/ros2/tera_msgs.

namespace tera::ros {

/// A message or a part of one. Its type name is T::kType.
template <typename T>
concept HasFields = requires {
  std::remove_cvref_t<T>::kType;
};

/// A byte sequence, uint8[].
struct Bytes {
  std::string_view data;
};

// Parts of messages, each built from another C++ type.

struct TimePart {
  static constexpr std::string_view kType = "builtin_interfaces/Time";
  TimeNs t_ns = 0;
};
struct Vector3Part {
  static constexpr std::string_view kType = "geometry_msgs/Vector3";
  Vec3 v = Vec3::Zero();
};
struct PointPart {
  static constexpr std::string_view kType = "geometry_msgs/Point";
  Vec3 p = Vec3::Zero();
};
struct QuaternionPart {
  static constexpr std::string_view kType = "geometry_msgs/Quaternion";
  Quat q = Quat::Identity();
};
struct PosePart {
  static constexpr std::string_view kType = "geometry_msgs/Pose";
  Pose pose = Pose::Identity();
};
struct TransformPart {
  static constexpr std::string_view kType = "geometry_msgs/Transform";
  Pose pose = Pose::Identity();
};
struct TwistPart {
  static constexpr std::string_view kType = "geometry_msgs/Twist";
  Vec3 linear_mps = Vec3::Zero(), angular_radps = Vec3::Zero();
};
struct PoseWithCovariancePart {
  static constexpr std::string_view kType = "geometry_msgs/PoseWithCovariance";
  Pose pose = Pose::Identity();
};
struct TwistWithCovariancePart {
  static constexpr std::string_view kType = "geometry_msgs/TwistWithCovariance";
  TwistPart twist;
};
struct NavSatStatusPart {
  static constexpr std::string_view kType = "sensor_msgs/NavSatStatus";
  NavSatFix::Status status = NavSatFix::kNoFix;
};
struct RegionOfInterestPart {
  static constexpr std::string_view kType = "sensor_msgs/RegionOfInterest";
};
struct DimensionPart {
  static constexpr std::string_view kType = "std_msgs/MultiArrayDimension";
  std::string label;
  std::uint32_t size = 0, stride = 0;
};
struct ArrayLayoutPart {
  static constexpr std::string_view kType = "std_msgs/MultiArrayLayout";
  std::vector<DimensionPart> dimensions;
};
struct Float32ArrayPart {
  static constexpr std::string_view kType = "std_msgs/Float32MultiArray";
  ArrayLayoutPart layout;
  std::span<const float> data;
};
struct GridMapInfoPart {
  static constexpr std::string_view kType = "grid_map_msgs/GridMapInfo";
  double resolution_m = 0, length_x_m = 0, length_y_m = 0;
  Pose middle = Pose::Identity();
};
/// Stamp of a DeltaCan, without conversion to nanoseconds. M may be const.
template <typename M>
struct RawTimePart {
  static constexpr std::string_view kType = TimePart::kType;
  M& message;
};
template <typename M>
struct RawHeaderPart {
  static constexpr std::string_view kType = Header::kType;
  M& message;
};

void Fields(auto& visit, const TimePart& part) {
  const TimeNs known_ns = std::max<TimeNs>(0, part.t_ns);
  visit("sec", static_cast<std::int32_t>(known_ns / kNsPerSecond));
  visit("nanosec", static_cast<std::uint32_t>(known_ns % kNsPerSecond));
}
void Fields(auto& visit, const Header& header) {
  visit("stamp", TimePart{header.t_ns});
  visit("frame_id", header.frame_id);
}
void FieldsXyz(auto& visit, const Vec3& v) {
  visit("x", v.x());
  visit("y", v.y());
  visit("z", v.z());
}
void Fields(auto& visit, const Vector3Part& part) { FieldsXyz(visit, part.v); }
void Fields(auto& visit, const PointPart& part) { FieldsXyz(visit, part.p); }
void Fields(auto& visit, const QuaternionPart& part) {
  FieldsXyz(visit, part.q.vec());
  visit("w", part.q.w());
}
void Fields(auto& visit, const PosePart& part) {
  visit("position", PointPart{part.pose.translation()});
  visit("orientation", QuaternionPart{Quat(part.pose.linear()).normalized()});
}
void Fields(auto& visit, const TransformPart& part) {
  visit("translation", Vector3Part{part.pose.translation()});
  visit("rotation", QuaternionPart{Quat(part.pose.linear()).normalized()});
}
void Fields(auto& visit, const TwistPart& part) {
  visit("linear", Vector3Part{part.linear_mps});
  visit("angular", Vector3Part{part.angular_radps});
}
/// Zero covariance means unknown.
void Fields(auto& visit, const PoseWithCovariancePart& part) {
  visit("pose", PosePart{part.pose});
  visit("covariance", std::array<double, 36>{});
}
void Fields(auto& visit, const TwistWithCovariancePart& part) {
  visit("twist", part.twist);
  visit("covariance", std::array<double, 36>{});
}
void Fields(auto& visit, const Clock& message) { visit("clock", TimePart{message.t_ns}); }
void Fields(auto& visit, const Float64& message) { visit("data", message.data); }
void Fields(auto& visit, const PoseStamped& message) {
  visit("header", message.header);
  visit("pose", PosePart{message.pose});
}
void Fields(auto& visit, const TransformStamped& message) {
  visit("header", message.header);
  visit("child_frame_id", message.child_frame_id);
  visit("transform", TransformPart{message.pose});
}
void Fields(auto& visit, const TfMessage& message) { visit("transforms", message.transforms); }
void Fields(auto& visit, const Odometry& message) {
  visit("header", message.header);
  visit("child_frame_id", message.child_frame_id);
  visit("pose", PoseWithCovariancePart{message.pose});
  visit("twist", TwistWithCovariancePart{{message.linear_mps, message.angular_radps}});
}
void Fields(auto& visit, const JointState& message) {
  visit("header", message.header);
  visit("name", message.name);
  visit("position", message.position);
  visit("velocity", message.velocity);
  visit("effort", message.effort);
}
void Fields(auto& visit, const Imu& message) {
  visit("header", message.header);
  visit("orientation", QuaternionPart{});
  visit("orientation_covariance", Covariance3{-1});  // means that there is no orientation estimate
  visit("angular_velocity", Vector3Part{message.angular_velocity_radps});
  visit("angular_velocity_covariance", message.angular_velocity_covariance);
  visit("linear_acceleration", Vector3Part{message.linear_acceleration_mps2});
  visit("linear_acceleration_covariance", message.linear_acceleration_covariance);
}
void Fields(auto& visit, const NavSatStatusPart& part) {
  constexpr std::uint16_t kGps = 1;
  visit.Constant("int8 STATUS_NO_FIX=-1");
  visit.Constant("int8 STATUS_FIX=0");
  visit.Constant("int8 STATUS_SBAS_FIX=1");
  visit.Constant("int8 STATUS_GBAS_FIX=2");
  visit("status", part.status);
  visit.Constant("uint16 SERVICE_GPS=1");
  visit.Constant("uint16 SERVICE_GLONASS=2");
  visit.Constant("uint16 SERVICE_COMPASS=4");
  visit.Constant("uint16 SERVICE_GALILEO=8");
  visit("service", kGps);
}
void Fields(auto& visit, const NavSatFix& message) {
  visit("header", message.header);
  visit("status", NavSatStatusPart{message.status});
  visit("latitude", message.latitude_deg);
  visit("longitude", message.longitude_deg);
  visit("altitude", message.altitude_m);
  visit("position_covariance", message.position_covariance_m2);
  visit.Constant("uint8 COVARIANCE_TYPE_UNKNOWN=0");
  visit.Constant("uint8 COVARIANCE_TYPE_APPROXIMATED=1");
  visit.Constant("uint8 COVARIANCE_TYPE_DIAGONAL_KNOWN=2");
  visit.Constant("uint8 COVARIANCE_TYPE_KNOWN=3");
  visit("position_covariance_type", message.covariance_type);
}
void Fields(auto& visit, const Image& message) {
  visit("header", message.header);
  visit("height", message.height_px);
  visit("width", message.width_px);
  visit("encoding", message.encoding);
  visit("is_bigendian", std::uint8_t{0});
  visit("step", message.step_bytes);
  visit("data", message.data);
}
void Fields(auto& visit, const CompressedImage& message) {
  visit("header", message.header);
  visit("format", message.format);
  visit("data", Bytes{message.data});
}
/// Zeros mean the whole image.
void Fields(auto& visit, const RegionOfInterestPart&) {
  for (const char* name : {"x_offset", "y_offset", "height", "width"}) {
    visit(name, std::uint32_t{0});
  }
  visit("do_rectify", false);
}
void Fields(auto& visit, const CameraInfo& message) {
  const std::array<double, 9>& k = message.k;
  visit("header", message.header);
  visit("height", message.height_px);
  visit("width", message.width_px);
  visit("distortion_model", message.distortion_model);
  visit("d", message.d);
  visit("k", k);
  visit("r", std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  visit("p", std::array<double, 12>{k[0], k[1], k[2], 0, k[3], k[4], k[5], 0, k[6], k[7], k[8], 0});
  visit("binning_x", std::uint32_t{0});
  visit("binning_y", std::uint32_t{0});
  visit("roi", RegionOfInterestPart{});
}
void Fields(auto& visit, const PointField& field) {
  for (const char* line :
       {"uint8 INT8=1", "uint8 UINT8=2", "uint8 INT16=3", "uint8 UINT16=4", "uint8 INT32=5",
        "uint8 UINT32=6", "uint8 FLOAT32=7", "uint8 FLOAT64=8"}) {
    visit.Constant(line);
  }
  visit("name", field.name);
  visit("offset", field.offset);
  visit("datatype", field.datatype);
  visit("count", std::uint32_t{1});
}
/// The points are one row without missing points.
void Fields(auto& visit, const PointCloud2& message) {
  const std::size_t points =
      message.point_step_bytes > 0 ? message.data.size() / message.point_step_bytes : 0;
  visit("header", message.header);
  visit("height", std::uint32_t{1});
  visit("width", static_cast<std::uint32_t>(points));
  visit("fields", message.fields);
  visit("is_bigendian", false);
  visit("point_step", message.point_step_bytes);
  visit("row_step", static_cast<std::uint32_t>(message.data.size()));
  visit("data", message.data);
  visit("is_dense", true);
}
void Fields(auto& visit, const DimensionPart& part) {
  visit("label", part.label);
  visit("size", part.size);
  visit("stride", part.stride);
}
void Fields(auto& visit, const ArrayLayoutPart& part) {
  visit("dim", part.dimensions);
  visit("data_offset", std::uint32_t{0});
}
void Fields(auto& visit, const Float32ArrayPart& part) {
  visit("layout", part.layout);
  visit("data", part.data);
}
void Fields(auto& visit, const GridMapInfoPart& part) {
  visit("resolution", part.resolution_m);
  visit("length_x", part.length_x_m);
  visit("length_y", part.length_y_m);
  visit("pose", PosePart{part.middle});
}
void Fields(auto& visit, const GridMap& message) {
  std::vector<std::string> names, basic;
  std::vector<Float32ArrayPart> data;
  for (const GridMap::Layer& layer : message.layers) {
    names.push_back(layer.name);
    if (layer.name == "elevation") basic.push_back(layer.name);
    data.push_back({{{{"column_index", message.columns, message.rows * message.columns},
                      {"row_index", message.rows, message.rows}}},
                    layer.values});
  }
  visit("header", message.header);
  visit("info", GridMapInfoPart{message.resolution_m, message.resolution_m * message.rows,
                                message.resolution_m * message.columns, message.middle});
  visit("layers", names);
  visit("basic_layers", basic);
  visit("data", data);
  // A grid map may be a circular buffer. Here it starts at index 0.
  visit("outer_start_index", std::uint16_t{0});
  visit("inner_start_index", std::uint16_t{0});
}
template <typename M>
void Fields(auto& visit, const RawTimePart<M>& part) {
  visit("sec", part.message.stamp_sec);
  visit("nanosec", part.message.stamp_nanosec);
}
/// The frame id is ignored.
template <typename M>
void Fields(auto& visit, const RawHeaderPart<M>& part) {
  std::string frame_id;
  visit("stamp", RawTimePart<M>{part.message});
  visit("frame_id", frame_id);
}
template <typename M>
requires std::same_as<std::remove_const_t<M>, DeltaCan>
void Fields(auto& visit, M& message) {
  visit("header", RawHeaderPart<M>{message});
  visit("slew", message.slew);
  visit("boom", message.boom);
  visit("arm", message.arm);
  visit("bucket", message.bucket);
  visit("left_travel", message.left_travel);
  visit("right_travel", message.right_travel);
  visit("blade", message.blade);
  visit("swing", message.swing);
  visit("enable", message.enable);
  visit("hydraulic_lock", message.hydraulic_lock);
  visit("high_speed", message.high_speed);
  visit("others", message.others);
}

}  // namespace tera::ros
