#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/motion.h"
#include "core/time.h"

/// ROS's messages as plain data: those that a simulation publishes or a recording becomes, and the
/// levers that a simulation listens to. Fields and units are those of the ROS definitions of the
/// same name.
///
/// Source  common_interfaces, geometry2 and rcl_interfaces, branch humble; REP 103 (units, axes),
///         REP 105 (frames), REP 118 (depth images).

namespace tera::ros {

/// When and in which frame. A time before 0 has no place on the wire and counts as 0.
struct Header {
  TimeNs t_ns = 0;
  std::string frame_id;
};

/// A 3 x 3 covariance, row-major. All zero: not known.
using Covariance3 = std::array<double, 9>;

/// rosgraph_msgs/msg/Clock
struct Clock {
  TimeNs t_ns = 0;
};

/// std_msgs/msg/Float64
struct Float64 {
  double data = 0;
};

/// geometry_msgs/msg/PoseStamped: the pose of something in the header's frame.
struct PoseStamped {
  Header header;
  Pose pose = Pose::Identity();
};

/// geometry_msgs/msg/TransformStamped: the pose of the child in the header's frame.
struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Pose pose = Pose::Identity();
};

/// tf2_msgs/msg/TFMessage
struct TfMessage {
  std::vector<TransformStamped> transforms;
};

/// nav_msgs/msg/Odometry without covariances: the pose of the child in the header's frame, its
/// velocities in its own.
struct Odometry {
  Header header;
  std::string child_frame_id;
  Pose pose = Pose::Identity();
  Vec3 linear_mps = Vec3::Zero(), angular_radps = Vec3::Zero();
};

/// sensor_msgs/msg/JointState: radians, rad/s, Nm, or metres, m/s, N where a joint slides. `effort`
/// may be empty.
struct JointState {
  Header header;
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;
};

/// sensor_msgs/msg/Imu of a unit that estimates no orientation.
struct Imu {
  Header header;
  Vec3 angular_velocity_radps = Vec3::Zero(), linear_acceleration_mps2 = Vec3::Zero();
  Covariance3 angular_velocity_covariance = {}, linear_acceleration_covariance = {};
};

/// sensor_msgs/msg/NavSatFix. Altitude above the ellipsoid, covariance along east, north, up.
struct NavSatFix {
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

/// sensor_msgs/msg/Image, little-endian.
struct Image {
  Header header;
  std::uint32_t height_px = 0, width_px = 0;
  std::string encoding;
  std::uint32_t step_bytes = 0;  ///< of a row
  std::vector<std::uint8_t> data;
};

/// sensor_msgs/msg/CompressedImage: a picture as a file has it.
struct CompressedImage {
  Header header;
  std::string format;
  std::string data;
};

/// sensor_msgs/msg/CameraInfo of a camera whose pictures are not rectified: r is the identity and p
/// is k.
struct CameraInfo {
  Header header;
  std::uint32_t height_px = 0, width_px = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k = {};
};

/// sensor_msgs/msg/PointField
struct PointField {
  enum Datatype : std::uint8_t { kUint8 = 2, kUint16 = 4, kUint32 = 6, kFloat32 = 7 };
  std::string name;
  std::uint32_t offset = 0;
  Datatype datatype = kFloat32;
};

/// sensor_msgs/msg/PointCloud2: one row of points, little-endian, each of them a measurement.
struct PointCloud2 {
  Header header;
  std::vector<PointField> fields;
  std::uint32_t point_step_bytes = 0;
  std::vector<std::uint8_t> data;
};

/// grid_map_msgs/msg/GridMap: layers of numbers on the squares of a plane, NaN where none is known.
/// Not published live.
///
/// Model   rows run down x, columns down y, both from the corner that has the most of both; a layer
///         is column after column. No layer is needed for a square to be valid but `elevation`.
/// Source  ANYbotics/grid_map, grid_map_msgs, branches ros2 (master of ROS 1 has the header in the
///         message's `info`) and grid_map_ros, GridMapRosConverter.
struct GridMap {
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

/// What a live simulation publishes.
using Message = std::variant<Clock, Float64, PoseStamped, TfMessage, Odometry, JointState, Imu,
                             NavSatFix, Image, CameraInfo, PointCloud2>;

/// tera_msgs/msg/DeltaCAN. Of one that came nothing has been checked yet.
struct DeltaCan {
  /// The header's stamp as it came.
  std::int32_t stamp_sec = 0;
  std::uint32_t stamp_nanosec = 0;
  /// Lever positions in [-1, 1]; the travel levers drive forward at +1.
  float slew = 0, boom = 0, arm = 0, bucket = 0;
  float left_travel = 0, right_travel = 0, blade = 0, swing = 0;
  bool enable = false;          ///< without it the machine holds still
  bool hydraulic_lock = false;  ///< no lever reaches the valves
  bool high_speed = false;      ///< travel in the second gear
  /// Positions of the levers that have no field of their own, in the order of the machine's levers;
  /// none: they are neutral.
  std::vector<float> others;
};

}  // namespace tera::ros
