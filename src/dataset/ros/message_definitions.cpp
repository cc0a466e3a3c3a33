#include "dataset/ros/message_definitions.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/check.h"

namespace tera::ros {
namespace {

constexpr std::string_view kTime = "builtin_interfaces/Time", kHeader = "std_msgs/Header";

struct Definition {
  std::string_view type, text;
};

/// Source  the published definitions of common_interfaces, geometry2, rcl_interfaces and grid_map;
///         examples/ros2/tera_msgs.
constexpr std::array<Definition, 46> kDefinitions = {{
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/Float64", "float64 data\n"},
    {"std_msgs/Bool", "bool data\n"},
    {"std_msgs/Float32", "float32 data\n"},
    {"std_msgs/Int32", "int32 data\n"},
    {"std_msgs/String", "string data\n"},
    {"std_msgs/MultiArrayDimension", "string label\nuint32 size\nuint32 stride\n"},
    {"std_msgs/MultiArrayLayout", "std_msgs/MultiArrayDimension[] dim\nuint32 data_offset\n"},
    {"std_msgs/Float64MultiArray", "std_msgs/MultiArrayLayout layout\nfloat64[] data\n"},
    {"std_msgs/Float32MultiArray", "std_msgs/MultiArrayLayout layout\nfloat32[] data\n"},
    {"rosgraph_msgs/Clock", "builtin_interfaces/Time clock\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/Transform",
     "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    {"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    {"geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    {"geometry_msgs/PoseWithCovarianceStamped",
     "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"},
    {"geometry_msgs/TwistStamped", "std_msgs/Header header\ngeometry_msgs/Twist twist\n"},
    {"geometry_msgs/Vector3Stamped", "std_msgs/Header header\ngeometry_msgs/Vector3 vector\n"},
    {"geometry_msgs/PointStamped", "std_msgs/Header header\ngeometry_msgs/Point point\n"},
    {"geometry_msgs/Wrench", "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n"},
    {"geometry_msgs/WrenchStamped", "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n"},
    {"sensor_msgs/FluidPressure",
     "std_msgs/Header header\nfloat64 fluid_pressure\nfloat64 variance\n"},
    {"sensor_msgs/MagneticField",
     "std_msgs/Header header\ngeometry_msgs/Vector3 magnetic_field\n"
     "float64[9] magnetic_field_covariance\n"},
    {"sensor_msgs/Joy", "std_msgs/Header header\nfloat32[] axes\nint32[] buttons\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"nav_msgs/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
     "geometry_msgs/TwistWithCovariance twist\n"},
    {"sensor_msgs/JointState",
     "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
     "float64[] effort\n"},
    {"sensor_msgs/Imu",
     "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
     "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
     "float64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n"
     "float64[9] linear_acceleration_covariance\n"},
    {"sensor_msgs/NavSatStatus",
     "int8 STATUS_NO_FIX=-1\nint8 STATUS_FIX=0\nint8 STATUS_SBAS_FIX=1\nint8 STATUS_GBAS_FIX=2\n"
     "int8 status\nuint16 SERVICE_GPS=1\nuint16 SERVICE_GLONASS=2\nuint16 SERVICE_COMPASS=4\n"
     "uint16 SERVICE_GALILEO=8\nuint16 service\n"},
    {"sensor_msgs/NavSatFix",
     "std_msgs/Header header\nsensor_msgs/NavSatStatus status\nfloat64 latitude\n"
     "float64 longitude\nfloat64 altitude\nfloat64[9] position_covariance\n"
     "uint8 COVARIANCE_TYPE_UNKNOWN=0\nuint8 COVARIANCE_TYPE_APPROXIMATED=1\n"
     "uint8 COVARIANCE_TYPE_DIAGONAL_KNOWN=2\nuint8 COVARIANCE_TYPE_KNOWN=3\n"
     "uint8 position_covariance_type\n"},
    {"sensor_msgs/Image",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"
     "uint32 step\nuint8[] data\n"},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"sensor_msgs/RegionOfInterest",
     "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"},
    {"sensor_msgs/CameraInfo",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\n"
     "float64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\n"
     "sensor_msgs/RegionOfInterest roi\n"},
    {"sensor_msgs/PointField",
     "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n"
     "uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 "
     "count\n"},
    {"sensor_msgs/PointCloud2",
     "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"},
    {"grid_map_msgs/GridMapInfo",
     "float64 resolution\nfloat64 length_x\nfloat64 length_y\ngeometry_msgs/Pose pose\n"},
    {"grid_map_msgs/GridMap",
     "std_msgs/Header header\ngrid_map_msgs/GridMapInfo info\nstring[] layers\n"
     "string[] basic_layers\nstd_msgs/Float32MultiArray[] data\nuint16 outer_start_index\n"
     "uint16 inner_start_index\n"},
    {"tera_msgs/DeltaCAN",
     "std_msgs/Header header\nfloat32 slew\nfloat32 boom\nfloat32 arm\nfloat32 bucket\n"
     "float32 left_travel\nfloat32 right_travel\nfloat32 blade\nfloat32 swing\nbool enable\n"
     "bool hydraulic_lock\nbool high_speed\nfloat32[] others\n"},
}};

/// A line as a type and the rest of it, which begins with the blank.
std::pair<std::string_view, std::string_view> TypeAndRest(std::string_view line) {
  const std::size_t blank = line.find(' ');
  return {line.substr(0, blank), line.substr(blank)};
}

std::vector<std::string_view> Lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

/// Without the brackets of an array.
std::string_view ElementOf(std::string_view type) { return type.substr(0, type.find('[')); }

/// How ROS 1 names a field of a type that ROS 2 has too.
std::string Ros1Line(std::string_view owner, std::string_view line) {
  const auto [type, rest] = TypeAndRest(line);
  if (type == kTime) return "time" + std::string(rest);
  if (type == kHeader) return "Header" + std::string(rest);
  std::string text(line);
  // Matrices of a camera have capital letters there.
  if (owner == "sensor_msgs/CameraInfo" && rest.size() == 2) {
    text.back() = static_cast<char>(text.back() - 'a' + 'A');
  }
  return text;
}

std::string Text(std::string_view type, WireForm form) {
  if (form == WireForm::kCdr) return std::string(DefinitionOf(type));
  std::string text = type == kHeader ? "uint32 seq\n" : "";
  // There a grid map has its header in its info.
  if (type == "grid_map_msgs/GridMapInfo") text = "Header header\n";
  for (const std::string_view line : Lines(DefinitionOf(type))) {
    const std::string own = Ros1Line(type, line) + "\n";
    if (type != "grid_map_msgs/GridMap" || own != "Header header\n") text += own;
  }
  return text;
}

/// The types that a type is made of, each once, in the order in which they are met.
void Gather(std::string_view type, WireForm form, std::set<std::string_view>* seen,
            std::vector<std::string_view>* parts) {
  for (const std::string_view line : Lines(DefinitionOf(type))) {
    const std::string_view part = ElementOf(TypeAndRest(line).first);
    const bool is_plain = part.find('/') == std::string_view::npos;
    if (is_plain || (form == WireForm::kRos1 && part == kTime)) continue;
    if (!seen->insert(part).second) continue;
    parts->push_back(part);
    Gather(part, form, seen, parts);
  }
}

std::string Md5Of(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  TERA_CHECK(EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_md5(), nullptr) == 1);
  std::string hex;
  for (unsigned k = 0; k < size; ++k) hex += fmt::format("{:02x}", digest[k]);
  return hex;
}

}  // namespace

std::optional<std::string_view> FindDefinition(std::string_view type) {
  for (const Definition& definition : kDefinitions) {
    if (definition.type == type) return definition.text;
  }
  return std::nullopt;
}

std::string_view DefinitionOf(std::string_view type) {
  const auto definition = FindDefinition(type);
  TERA_CHECK(definition.has_value(), type);
  return *definition;
}

std::string OwnDefinition(std::string_view type, WireForm form) { return Text(type, form); }

std::string Md5Sum(std::string_view type) {
  const std::string definition = Text(type, WireForm::kRos1);
  std::string constants, fields;
  for (const std::string_view line : Lines(definition)) {
    const auto [field_type, rest] = TypeAndRest(line);
    if (line.find('=') != std::string_view::npos) {
      constants += std::string(line) + "\n";
    } else if (field_type == "Header") {
      fields += Md5Sum(kHeader) + std::string(rest) + "\n";
    } else if (field_type.find('/') != std::string_view::npos) {
      fields += Md5Sum(ElementOf(field_type)) + std::string(rest) + "\n";
    } else {
      fields += std::string(line) + "\n";
    }
  }
  std::string text = constants + fields;
  text.pop_back();
  return Md5Of(text);
}

std::string FullTypeName(std::string_view type, WireForm form) {
  std::string name(type);
  if (form == WireForm::kCdr) name.insert(name.find('/'), "/msg");
  return name;
}

std::string FullDefinition(std::string_view type, WireForm form) {
  constexpr std::size_t kEqualsSigns = 80;
  std::set<std::string_view> seen;
  std::vector<std::string_view> parts;
  Gather(type, form, &seen, &parts);
  std::string text = Text(type, form);
  for (const std::string_view part : parts) {
    text += std::string(kEqualsSigns, '=') + "\nMSG: " + std::string(part) + "\n";
    text += Text(part, form);
  }
  return text;
}

}  // namespace tera::ros
