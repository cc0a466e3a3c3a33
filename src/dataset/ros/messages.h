#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/motion.h"
#include "core/time.h"

/// ROS messages as plain data. A simulation publishes most of them, an export writes them, and
/// DeltaCan is received by a simulation. Units are those of the ROS definitions. message_fields.h
/// lists the fields.
///
/// Source  common_interfaces, geometry2 and rcl_interfaces, branch humble; REP 103 (units, axes),
///         REP 105 (frames), REP 118 (depth images).

namespace tera::ros {

/// Time stamp and frame. ROS has no negative times; they are sent as 0.
struct Header {
  static constexpr std::string_view kType = "std_msgs/Header";
  TimeNs t_ns = 0;
  std::string frame_id;
};

/// Row-major 3 x 3 covariance. All zero means unknown.
using Covariance3 = std::array<double, 9>;

struct Clock {
  static constexpr std::string_view kType = "rosgraph_msgs/Clock";
  TimeNs t_ns = 0;
};

struct Float64 {
  static constexpr std::string_view kType = "std_msgs/Float64";
  double data = 0;
};

/// A pose in the header's frame.
struct PoseStamped {
  static constexpr std::string_view kType = "geometry_msgs/PoseStamped";
  Header header;
  Pose pose = Pose::Identity();
};

/// The pose of the child in the header's frame.
struct TransformStamped {
  static constexpr std::string_view kType = "geometry_msgs/TransformStamped";
  Header header;
  std::string child_frame_id;
  Pose pose = Pose::Identity();
};

struct TfMessage {
  static constexpr std::string_view kType = "tf2_msgs/TFMessage";
  std::vector<TransformStamped> transforms;
};

/// Pose of the child in the header's frame, with velocities in the child's frame. Covariances are
/// not set.
struct Odometry {
  static constexpr std::string_view kType = "nav_msgs/Odometry";
  Header header;
  std::string child_frame_id;
  Pose pose = Pose::Identity();
  Vec3 linear_mps = Vec3::Zero(), angular_radps = Vec3::Zero();
};

/// Units are rad, rad/s and Nm; for prismatic joints m, m/s and N. `effort` may be empty.
struct JointState {
  static constexpr std::string_view kType = "sensor_msgs/JointState";
  Header header;
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;
};

/// An IMU without an orientation estimate.
struct Imu {
  static constexpr std::string_view kType = "sensor_msgs/Imu";
  Header header;
  Vec3 angular_velocity_radps = Vec3::Zero(), linear_acceleration_mps2 = Vec3::Zero();
  Covariance3 angular_velocity_covariance = {}, linear_acceleration_covariance = {};
};

/// Altitude is above the ellipsoid. The covariance is along east, north, up.
struct NavSatFix {
  static constexpr std::string_view kType = "sensor_msgs/NavSatFix";
  enum Status : std::int8_t {
    kNoFix = -1,
    kFix = 0,
    kSatelliteAugmented = 1,
    kGroundAugmented = 2
  };
  enum CovarianceType : std::uint8_t { kUnknown = 0, kDiagonalKnown = 2 };
  Header header;
  Status status = kNoFix;
  double latitude_deg = 0, longitude_deg = 0, altitude_m = 0;
  Covariance3 position_covariance_m2 = {};
  CovarianceType covariance_type = kUnknown;
};

/// Multi-byte values are little-endian.
struct Image {
  static constexpr std::string_view kType = "sensor_msgs/Image";
  Header header;
  std::uint32_t height_px = 0, width_px = 0;
  std::string encoding;
  std::uint32_t step_bytes = 0;  ///< bytes per row
  std::vector<std::uint8_t> data;
};

/// An image as the content of an image file.
struct CompressedImage {
  static constexpr std::string_view kType = "sensor_msgs/CompressedImage";
  Header header;
  std::string format;
  std::string data;
};

/// Camera without rectification: r is the identity, and p equals k.
struct CameraInfo {
  static constexpr std::string_view kType = "sensor_msgs/CameraInfo";
  Header header;
  std::uint32_t height_px = 0, width_px = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k = {};
};

struct PointField {
  static constexpr std::string_view kType = "sensor_msgs/PointField";
  enum Datatype : std::uint8_t { kUint8 = 2, kUint16 = 4, kUint32 = 6, kFloat32 = 7 };
  std::string name;
  std::uint32_t offset = 0;
  Datatype datatype = kFloat32;
};

/// Points in one row, little-endian, without missing points.
struct PointCloud2 {
  static constexpr std::string_view kType = "sensor_msgs/PointCloud2";
  Header header;
  std::vector<PointField> fields;
  std::uint32_t point_step_bytes = 0;
  std::vector<std::uint8_t> data;
};

/// Layers of numbers on a grid; NaN: unknown. Only bags contain it.
///
/// Model   Row index grows with decreasing x and column index with decreasing y, so index (0, 0) is
///         at the largest x and y. A layer is stored in column-major order. A cell is valid if
///         `elevation` is.
/// Source  ANYbotics/grid_map, grid_map_msgs, branches ros2 (master of ROS 1 has the header in the
///         message's `info`) and grid_map_ros, GridMapRosConverter.
struct GridMap {
  static constexpr std::string_view kType = "grid_map_msgs/GridMap";
  struct Layer {
    std::string name;
    std::vector<float> values;
  };
  Header header;
  double resolution_m = 0;
  std::uint32_t rows = 0, columns = 0;
  Pose middle = Pose::Identity();
  std::vector<Layer> layers;
};

/// Messages that a live simulation publishes.
using Message = std::variant<Clock, Float64, PoseStamped, TfMessage, Odometry, JointState, Imu,
                             NavSatFix, Image, CameraInfo, PointCloud2>;

/// Lever commands to a simulation. The content of a received message is not validated.
struct DeltaCan {
  static constexpr std::string_view kType = "tera_msgs/DeltaCAN";
  /// Stamp in the header, not converted.
  std::int32_t stamp_sec = 0;
  std::uint32_t stamp_nanosec = 0;
  /// Lever positions in [-1, 1]. A travel lever at +1 drives forward.
  float slew = 0, boom = 0, arm = 0, bucket = 0;
  float left_travel = 0, right_travel = 0, blade = 0, swing = 0;
  bool enable = false;          ///< false: the machine stands still
  bool hydraulic_lock = false;  ///< true: levers have no effect on the valves
  bool high_speed = false;      ///< true: second travel gear
  /// Positions of levers that have no field of their own, in the order of the machine's levers;
  /// empty: all neutral.
  std::vector<float> others;
};

}  // namespace tera::ros
