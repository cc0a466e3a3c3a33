#include "dataset/ros/message_definitions.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/check.h"
#include "dataset/ros/message_fields.h"

namespace tera::ros {
namespace {

constexpr std::string_view kTime = TimePart::kType, kHeader = Header::kType;

/// Definitions of types that TERA reads but does not write.
///
/// Source  the published definitions of common_interfaces and geometry2.
constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kFurther = {{
    {"std_msgs/Bool", "bool data\n"},
    {"std_msgs/Float32", "float32 data\n"},
    {"std_msgs/Int32", "int32 data\n"},
    {"std_msgs/String", "string data\n"},
    {"std_msgs/Float64MultiArray", "std_msgs/MultiArrayLayout layout\nfloat64[] data\n"},
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
}};

/// Visitor for Fields that writes the definition of a type.
struct DefinitionWriter {
  std::string text;

  template <typename T>
  void operator()(std::string_view name, const T&) {
    text += fmt::format("{} {}\n", NameOf<T>(), name);
  }
  void Constant(std::string_view line) { text += fmt::format("{}\n", line); }

  template <typename T>
  static std::string NameOf() {
    if constexpr (HasFields<T>) {
      return std::string(T::kType);
    } else if constexpr (std::is_same_v<T, bool>) {
      return "bool";
    } else if constexpr (std::is_enum_v<T>) {
      return NameOf<std::underlying_type_t<T>>();
    } else if constexpr (std::is_floating_point_v<T>) {
      return fmt::format("float{}", 8 * sizeof(T));
    } else if constexpr (std::is_integral_v<T>) {
      return fmt::format("{}int{}", std::is_signed_v<T> ? "" : "u", 8 * sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      return "string";
    } else if constexpr (std::is_same_v<T, Bytes>) {
      return "uint8[]";
    } else if constexpr (requires { std::tuple_size<T>::value; }) {
      return fmt::format("{}[{}]", NameOf<typename T::value_type>(), std::tuple_size_v<T>);
    } else {
      return NameOf<typename T::value_type>() + "[]";
    }
  }
};

template <typename T>
std::pair<std::string_view, std::string> Described() {
  DefinitionWriter writer;
  const T message{};
  Fields(writer, message);
  return {T::kType, std::move(writer.text)};
}

template <typename... T>
std::map<std::string_view, std::string> AllDescribed() {
  std::map<std::string_view, std::string> definitions{Described<T>()...};
  definitions.insert(kFurther.begin(), kFurther.end());
  return definitions;
}

const std::map<std::string_view, std::string>& Definitions() {
  static const auto definitions =
      AllDescribed<TimePart, Header, Float64, DimensionPart, ArrayLayoutPart, Float32ArrayPart,
                   Clock, Vector3Part, PointPart, QuaternionPart, PosePart, TransformPart,
                   TwistPart, PoseWithCovariancePart, TwistWithCovariancePart, PoseStamped,
                   TransformStamped, TfMessage, Odometry, JointState, Imu, NavSatStatusPart,
                   NavSatFix, Image, CompressedImage, RegionOfInterestPart, CameraInfo, PointField,
                   PointCloud2, GridMapInfoPart, GridMap, DeltaCan>();
  return definitions;
}

/// Splits a line into its type and the rest, which begins with a blank.
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

/// Removes the brackets of an array type.
std::string_view ElementOf(std::string_view type) { return type.substr(0, type.find('[')); }

/// Converts the line of a field to ROS 1 notation.
std::string Ros1Line(std::string_view owner, std::string_view line) {
  const auto [type, rest] = TypeAndRest(line);
  if (type == kTime) return "time" + std::string(rest);
  if (type == kHeader) return "Header" + std::string(rest);
  std::string text(line);
  // In ROS 1, the matrices of a camera have upper-case names.
  if (owner == CameraInfo::kType && rest.size() == 2) {
    text.back() = static_cast<char>(text.back() - 'a' + 'A');
  }
  return text;
}

std::string Text(std::string_view type, WireForm form) {
  if (form == WireForm::kCdr) return std::string(DefinitionOf(type));
  std::string text = type == kHeader ? "uint32 seq\n" : "";
  // In ROS 1, the header of a grid map is part of its info.
  if (type == GridMapInfoPart::kType) text = "Header header\n";
  for (const std::string_view line : Lines(DefinitionOf(type))) {
    const std::string own = Ros1Line(type, line) + "\n";
    if (type != GridMap::kType || own != "Header header\n") text += own;
  }
  return text;
}

/// Types contained in a type, without duplicates, in order of first occurrence.
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
  const auto found = Definitions().find(type);
  if (found != Definitions().end()) return found->second;
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
