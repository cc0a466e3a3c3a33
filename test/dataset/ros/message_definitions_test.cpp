#include "dataset/ros/message_definitions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <string>

namespace tera::ros {
namespace {

/// Fields of ROS 2 Humble's messages, from another program (see test/ros2/data).
std::map<std::string, std::string> HumbleFields() {
  std::map<std::string, std::string> fields;
  std::ifstream file("test/ros2/data/humble_messages.txt");
  std::string type;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    if (line.starts_with("  ")) {
      fields[type] += line.substr(2) + "\n";
    } else {
      type = line;
    }
  }
  return fields;
}

std::string WithoutConstants(const std::string& definition) {
  return std::regex_replace(definition, std::regex("[^\n]*=[^\n]*\n"), "");
}

TEST(MessageDefinitions, AreThoseOfHumble) {
  const auto humble = HumbleFields();
  ASSERT_EQ(humble.size(), 25u);
  for (const auto& [type, fields] : humble) {
    EXPECT_EQ(WithoutConstants(std::string(DefinitionOf(type))), fields) << type;
  }
}

// Users build the package of this message from the same file.
TEST(MessageDefinitions, OfTheLeversIsThatOfItsPackage) {
  std::ifstream file("examples/ros2/tera_msgs/msg/DeltaCAN.msg");
  std::string fields;
  for (std::string line; std::getline(file, line);) {
    line = std::regex_replace(line, std::regex(" *#.*"), "");
    if (!line.empty()) fields += line + "\n";
  }
  EXPECT_EQ(DefinitionOf("tera_msgs/DeltaCAN"), fields);
}

TEST(MessageDefinitions, BringEachTypeThatTheyAreMadeOfOnce) {
  const std::string rule(80, '=');
  EXPECT_EQ(FullDefinition("geometry_msgs/PoseStamped", WireForm::kCdr),
            "std_msgs/Header header\ngeometry_msgs/Pose pose\n" + rule +
                "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + rule +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + rule +
                "\nMSG: geometry_msgs/Pose\ngeometry_msgs/Point position\n"
                "geometry_msgs/Quaternion orientation\n" +
                rule + "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" + rule +
                "\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n");
}

TEST(MessageDefinitions, InRos1AreTimesAPlainTypeAndHeadersCounted) {
  const std::string rule(80, '=');
  EXPECT_EQ(FullDefinition("sensor_msgs/CompressedImage", WireForm::kRos1),
            "Header header\nstring format\nuint8[] data\n" + rule +
                "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n");
  EXPECT_THAT(FullDefinition("sensor_msgs/CameraInfo", WireForm::kRos1),
              testing::HasSubstr("float64[] D\nfloat64[9] K\nfloat64[9] R\nfloat64[12] P\n"));
}

TEST(MessageDefinitions, TypesHaveTheNamesOfTheirGeneration) {
  EXPECT_EQ(FullTypeName("sensor_msgs/Imu", WireForm::kCdr), "sensor_msgs/msg/Imu");
  EXPECT_EQ(FullTypeName("sensor_msgs/Imu", WireForm::kRos1), "sensor_msgs/Imu");
}

// The digests that ROS 1's own packages have (rosmsg md5).
TEST(MessageDefinitions, DigestsAreThoseOfRos1) {
  const std::map<std::string, std::string> expected = {
      {"std_msgs/Header", "2176decaecbce78abc3b96ef049fabed"},
      {"rosgraph_msgs/Clock", "a9c97c1d230cfc112e270351a944ee47"},
      {"std_msgs/Float64", "fdb28210bfa9d7c91146260178d9a584"},
      {"geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5"},
      {"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec"},
      {"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7"},
      {"sensor_msgs/JointState", "3066dcd76a6cfaef579bd0f34173e9fd"},
      {"sensor_msgs/Imu", "6a62c6daae103f4ff57a132d6f95cec2"},
      {"sensor_msgs/NavSatFix", "2d3a8cd499b9b4a0249fb98fd05cfa48"},
      {"sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743"},
      {"sensor_msgs/CompressedImage", "8f7a12909da2c9d3332d540a0977563f"},
      {"sensor_msgs/CameraInfo", "c9a58c1b0b154e0e6da7578cb991d214"},
      {"sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181"},
      {"std_msgs/Float32MultiArray", "6a40e0ffa6a17a503ac3f8616991b1f6"},
      {"grid_map_msgs/GridMapInfo", "43ee5430e1c253682111cb6bedac0ef9"},
      {"grid_map_msgs/GridMap", "95681e052b1f73bf87b7eb984382b401"}};
  for (const auto& [type, digest] : expected) EXPECT_EQ(Md5Sum(type), digest) << type;
}

}  // namespace
}  // namespace tera::ros
